#include "propagation/discover.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"
#include "propagation/aimed_pairs.h"
#include "propagation/launcher.h"
#include "propagation/walker.h"

namespace grimaldi {
namespace {

constexpr std::uint64_t block_size = 8192;
constexpr std::uint64_t aimed_block_size = 256;
constexpr std::uint32_t aim_stream = 4;
/// Blocks whose records are held at a time: what bounds the memory of a long pass, and how soon it can be stopped.
constexpr std::uint64_t blocks_at_a_time = 2048;
/// Seeds that are held before those of one sequence and cell are united.
constexpr std::size_t most_seeds = 8'000'000;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Unites the records of one block with what there is.
void merge(const BlockRecords& block, std::uint32_t passes, Discovered& all) {
  std::vector<std::uint32_t> number(block.sequences.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    number[i] = all.sequences.enter(block.sequences.hash(i), block.sequences[i]);
  }
  for (const Seed& seed : block.seeds)
    all.seeds.push_back({number[seed.sequence], seed.cell, passes, seed.crossed, seed.gain});
  all.segments += block.segments;
  all.flux.launched += block.flux.launched;
  all.flux.absorbed += block.flux.absorbed;
  all.flux.escaped += block.flux.escaped;
  all.flux.cut_by_depth += block.flux.cut_by_depth;
}

bool comes_before(const Seed& a, const Seed& b) {
  return a.sequence != b.sequence ? a.sequence < b.sequence : a.cell < b.cell;
}

/// Unites neighbours of one sequence and cell in [first, end); returns the new end.
Seed* unite(Seed* first, const Seed* end) {
  Seed* to = first;
  for (const Seed* seed = first; seed != end; ++seed) {
    if (to != first && to[-1].sequence == seed->sequence && to[-1].cell == seed->cell) {
      to[-1].passes |= seed->passes;
      to[-1].crossed |= seed->crossed;
      to[-1].gain = std::max(to[-1].gain, seed->gain);
    } else {
      *to++ = *seed;
    }
  }
  return to;
}

/// Sorts the seeds and unites those of one sequence and cell: dealt to their sequences, sorted by cell within each.
void unite_seeds(std::vector<Seed>& seeds, std::size_t sequences, unsigned threads) {
  std::vector<std::size_t> begins(sequences + 1, 0), kept(sequences, 0);
  for (const Seed& seed : seeds) ++begins[seed.sequence + 1];
  for (std::size_t i = 0; i < sequences; ++i) begins[i + 1] += begins[i];
  std::vector<Seed> dealt(seeds.size());
  {
    std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
    for (const Seed& seed : seeds) dealt[next[seed.sequence]++] = seed;
  }
  constexpr std::size_t sequences_per_block = 64;
  const std::size_t blocks = (sequences + sequences_per_block - 1) / sequences_per_block;
  for_each_block(blocks, threads, [&](std::size_t block, unsigned) {
    const std::size_t last = std::min(sequences, (block + 1) * sequences_per_block);
    for (std::size_t sequence = block * sequences_per_block; sequence < last; ++sequence) {
      Seed* const first = dealt.data() + begins[sequence];
      Seed* const end = dealt.data() + begins[sequence + 1];
      std::sort(first, end, [](const Seed& a, const Seed& b) { return a.cell < b.cell; });
      kept[sequence] = static_cast<std::size_t>(unite(first, end) - first);
    }
  });
  seeds.clear();
  for (std::size_t sequence = 0; sequence < sequences; ++sequence)
    seeds.insert(seeds.end(), dealt.begin() + std::ptrdiff_t(begins[sequence]),
                 dealt.begin() + std::ptrdiff_t(begins[sequence] + kept[sequence]));
}

}  // namespace

std::size_t Discovered::append(const Discovered& later) {
  std::vector<std::uint32_t> number(later.sequences.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    number[i] = sequences.enter(later.sequences.hash(i), later.sequences[i]);
  }
  const auto first = static_cast<std::ptrdiff_t>(seeds.size());
  for (const Seed& seed : later.seeds)
    seeds.push_back({number[seed.sequence], seed.cell, seed.passes, seed.crossed, seed.gain});
  std::stable_sort(seeds.begin() + first, seeds.end(), comes_before);
  seeds.resize(static_cast<std::size_t>(unite(seeds.data() + first, seeds.data() + seeds.size()) - seeds.data()));
  for (BlockedPath path : later.blocked) {
    path.sequence = number[path.sequence];
    blocked.push_back(path);
  }
  segments += later.segments;
  shadow_rays += later.shadow_rays;
  merge_seconds += later.merge_seconds;
  view_seconds += later.view_seconds;
  return static_cast<std::size_t>(first);
}

Discovered discover(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                    const Search& search, const std::function<void(double)>& progress, const std::atomic<bool>* stop) {
  const PlanDescription& request = plan.request;
  Discovered all;
  all.sequences.enter(empty_sequence, {});
  const bool needed = request.depth > 0 && (request.reflection || request.diffraction);
  const auto total = static_cast<std::uint64_t>(request.rays);
  const auto passes = static_cast<std::uint64_t>(request.passes);
  const std::uint64_t stride = search.stride;
  const std::uint64_t block_beams = std::max(block_size, stride), block_aims = std::max(aimed_block_size, stride);
  const auto launched_from = [stride](std::uint64_t first) { return (first + stride - 1) / stride * stride; };
  const ReflectanceTable reflectance(plan);
  const PatchRims rims(scene);
  const unsigned threads = request.threads ? request.threads : hardware_threads();
  std::vector<Walker> walkers;
  for (unsigned i = 0; i < threads; ++i) walkers.emplace_back(scene, tracer, plan, search, reflectance, rims);
  // One group's records are united while the next group walks.
  const auto merge_group = [&](const std::vector<BlockRecords>& records, std::uint32_t pass_bit) {
    const auto start = Clock::now();
    for (const BlockRecords& block : records) merge(block, pass_bit, all);
    if (all.seeds.size() > most_seeds) unite_seeds(all.seeds, all.sequences.size(), threads);
    all.merge_seconds += seconds_since(start);
  };
  std::future<void> merging;
  for (std::uint64_t pass = 0; needed && pass < passes; ++pass) {
    if (stop && *stop) break;
    const std::uint64_t count = (pass + 1) * total / passes - pass * total / passes;
    if (count == 0) continue;
    const Launcher launcher(request.seed, static_cast<std::uint32_t>(pass), count);
    const double spacing = std::sqrt(4 * pi / double(count));
    const std::uint64_t blocks = (count + block_beams - 1) / block_beams;
    // One beam to edges for 8 launched, at least one to each wedge, or to as many wedges as there are rays in the pass.
    const std::uint64_t wedges = most_edges(request) > 0 ? scene.wedges.wedges.size() : 0;
    const std::uint64_t aimed = wedges == 0
                                    ? 0
                                    : std::min(wedges, count) * std::max<std::uint64_t>(1, count / (8 * wedges)),
                        aimed_blocks = (aimed + block_aims - 1) / block_aims;
    for (std::uint64_t group = 0; group < blocks + aimed_blocks && !(stop && *stop); group += blocks_at_a_time) {
      std::vector<BlockRecords> records(std::min(blocks_at_a_time, blocks + aimed_blocks - group));
      for_each_block(
          records.size(), threads,
          [&](std::size_t place, unsigned thread) {
            const std::uint64_t block = group + place;
            Walker& walker = walkers[thread];
            walker.begin_block(spacing, records[place]);
            if (block >= blocks) {
              const std::uint64_t first = (block - blocks) * block_aims, end = std::min(aimed, first + block_aims);
              for (std::uint64_t i = launched_from(first); i < end; i += stride) {
                const std::uint64_t wedge = aimed >= wedges ? i % wedges : (pass * aimed + i) % wedges;
                const double along = (double(pass) + uniform4(request.seed, aim_stream, aimed >= wedges ? i : wedge,
                                                              std::uint32_t(pass))[0]) /
                                     double(passes);
                walker.walk_to_edge(request.transmitters[transmitter].position, std::uint32_t(wedge), along,
                                    ~(pass << 40 | (aimed >= wedges ? i : wedge)));
              }
              return;
            }
            const std::uint64_t end = std::min(count, (block + 1) * block_beams);
            for (std::uint64_t i = launched_from(block * block_beams); i < end; i += stride)
              walker.walk(request.transmitters[transmitter].position, launcher.direction(i), pass << 40 | i);
          },
          stop);
      const std::size_t done = records.size();
      if (merging.valid()) merging.get();
      merging = std::async(std::launch::async, merge_group, std::move(records), 1u << pass);
      if (progress) progress((double(pass) + double(group + done) / double(blocks + aimed_blocks)) / double(passes));
    }
    all.rays += (count + stride - 1) / stride;
    if (progress) progress(double(pass + 1) / double(passes));
  }
  if (merging.valid()) merging.get();
  const auto start = Clock::now();
  const std::vector<std::uint32_t> renumbered = all.sequences.sort();
  for (Seed& seed : all.seeds) seed.sequence = renumbered[seed.sequence];
  unite_seeds(all.seeds, all.sequences.size(), threads);
  all.merge_seconds += seconds_since(start);
  return all;
}

Discovered discover_pairs(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                          const Search& search, const std::function<void(double)>& progress,
                          const std::atomic<bool>* stop) {
  const PlanDescription& request = plan.request;
  Discovered all;
  all.sequences.enter(empty_sequence, {});
  const auto begin = Clock::now();
  const AimedPairs pairs(scene, tracer, plan, transmitter, search.stride, all.shadow_rays);
  all.view_seconds = seconds_since(begin);
  const ReflectanceTable reflectance(plan);
  const PatchRims rims(scene);
  const unsigned threads = request.threads ? request.threads : hardware_threads();
  std::vector<Walker> walkers;
  for (unsigned i = 0; i < threads; ++i) walkers.emplace_back(scene, tracer, plan, search, reflectance, rims);
  const auto passes = static_cast<std::size_t>(request.passes);
  const double spacing = std::sqrt(4 * pi * double(passes) / request.rays);
  constexpr std::size_t group = 256;
  for (std::size_t first = 0; first < pairs.blocks() && !(stop && *stop); first += group) {
    std::vector<BlockRecords> records(std::min(group, pairs.blocks() - first));
    for_each_block(
        records.size(), threads,
        [&](std::size_t place, unsigned thread) {
          walkers[thread].begin_block(spacing, records[place]);
          pairs.walk_block(first + place, walkers[thread]);
        },
        stop);
    const auto start = Clock::now();
    for (std::size_t place = 0; place < records.size(); ++place)
      merge(records[place], pairs.all() ? ~0u : 1u << pairs.row_of(first + place) % passes, all);
    if (all.seeds.size() > most_seeds) unite_seeds(all.seeds, all.sequences.size(), threads);
    all.merge_seconds += seconds_since(start);
    if (progress) progress(double(first + records.size()) / double(pairs.blocks()));
  }
  return all;
}

}  // namespace grimaldi
