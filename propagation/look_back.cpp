#include "propagation/look_back.h"

#include <algorithm>
#include <cmath>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"

namespace grimaldi {
namespace {

constexpr std::uint32_t back_stream = 6;
constexpr std::uint64_t rays_per_beam = 8;
constexpr std::uint64_t beams_per_block = 1024;

/// What a block of beams found: blocked paths with the faces between the transmitter and the cell.
struct Views {
  std::vector<BlockedPath> blocked;  ///< sequences numbered within the block
  SequenceTable sequences;
  std::uint64_t segments = 0;
};

class Viewer {
 public:
  Viewer(const Scene& scene, const Tracer& tracer, const Plan& plan, const Vec3& source, const CoverageGrid& grid,
         BackwardBeams beams)
      : scene_(scene),
        tracer_(tracer),
        source_(source),
        grid_(grid),
        beams_(beams),
        seed_(plan.request.seed),
        most_faces_(std::min(plan.request.depth - 1, plan.request.max_reflections)) {}

  void look(std::uint32_t cell, std::uint64_t beam, std::uint32_t pass, Views& out) const {
    const auto u = uniform4(seed_, back_stream, beam, pass);
    const auto points = grid_.of(cell);
    const std::size_t point = point_with_edges(points, u[0]);
    Vec3 origin = grid_.layout.centre(cell) + points[point].offset;
    const double rise = beams_ == BackwardBeams::upward ? u[1] : 2 * u[1] - 1, across = std::sqrt(1 - rise * rise);
    Vec3 direction{across * std::cos(2 * pi * u[2]), across * std::sin(2 * pi * u[2]), rise};
    std::array<Interaction, max_depth> faces;  // from the cell
    std::uint32_t leave = no_index;
    for (int count = 1; count <= most_faces_; ++count) {
      ++out.segments;
      const Hit hit = tracer_.nearest(origin, direction, leave);
      if (hit.triangle == no_index) return;
      const std::uint32_t patch = scene_.patches.triangle_patch[hit.triangle];
      faces[static_cast<std::size_t>(count - 1)] = leave = patch;
      origin = origin + hit.distance * direction;
      const Vec3& normal = scene_.patches.patches[patch].normal;
      direction = direction - 2 * dot(direction, normal) * normal;
      note(cell, point, origin, {faces.data(), static_cast<std::size_t>(count)}, out);
    }
  }

 private:
  static std::size_t point_with_edges(std::span<const SubPoint> points, double u) {
    const auto edges = static_cast<std::size_t>(
        std::count_if(points.begin(), points.end(), [](const SubPoint& p) { return p.edge_weight > 0; }));
    auto left = static_cast<std::size_t>(u * double(edges));
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].edge_weight > 0 && left-- == 0) return i;
    return 0;
  }

  void note(std::uint32_t cell, std::size_t point, const Vec3& seen, std::span<const Interaction> faces,
            Views& out) const {
    const std::uint32_t patch = faces.back();
    const Vec3 way = seen - source_;
    const double length = norm(way);
    ++out.segments;
    const Hit hit = tracer_.nearest(source_, way / length);
    if (hit.triangle == no_index || scene_.patches.triangle_patch[hit.triangle] == patch) return;
    std::array<Interaction, max_depth> sequence;
    std::reverse_copy(faces.begin(), faces.end(), sequence.begin());
    const std::span<const Interaction> interactions(sequence.data(), faces.size());
    out.blocked.push_back(
        {out.sequences.enter(hash_of(interactions), interactions), cell, 0, static_cast<std::uint8_t>(point)});
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Vec3 source_;
  const CoverageGrid& grid_;
  const BackwardBeams beams_;
  const std::uint64_t seed_;
  const int most_faces_;
};

}  // namespace

void look_back(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
               const CoverageGrid& grid, BackwardBeams beams, Discovered& discovered, const std::atomic<bool>* stop,
               std::uint64_t stride) {
  const PlanDescription& request = plan.request;
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < grid.layout.size(); ++cell)
    if (!grid.of(cell).empty()) cells.push_back(cell);
  if (cells.empty() || !request.reflection || most_edges(request) == 0) return;
  const Viewer viewer(scene, tracer, plan, request.transmitters[transmitter].position, grid, beams);
  const unsigned threads = request.threads ? request.threads : hardware_threads();
  const auto passes = static_cast<std::uint64_t>(request.passes);
  const auto total = static_cast<std::uint64_t>(request.rays) / (rays_per_beam * stride);
  for (std::uint64_t pass = 0; pass < passes && !(stop && *stop); ++pass) {
    const std::uint64_t first = pass * total / passes, last = (pass + 1) * total / passes;
    std::vector<Views> views((last - first + beams_per_block - 1) / beams_per_block);
    for_each_block(
        views.size(), threads,
        [&](std::size_t block, unsigned) {
          const std::uint64_t begin = first + block * beams_per_block;
          for (std::uint64_t i = begin; i < std::min(last, begin + beams_per_block); ++i)
            viewer.look(cells[i % cells.size()], i, static_cast<std::uint32_t>(pass), views[block]);
        },
        stop);
    for (const Views& block : views) {
      discovered.segments += block.segments;
      for (BlockedPath path : block.blocked) {
        path.sequence = discovered.sequences.enter(block.sequences.hash(path.sequence), block.sequences[path.sequence]);
        discovered.blocked.push_back(path);
      }
    }
  }
}

}  // namespace grimaldi
