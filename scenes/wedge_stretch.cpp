#include "scenes/wedge_stretch.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

constexpr double sample_step = 0.5;            // m
constexpr double change_width = 1e-3;          // m
constexpr double same_angle = 0.5 * pi / 180;  // rad, between sectors taken as one
constexpr double least_stretch = 2.5 * contact_distance;
constexpr double least_angle = pi + flat_tolerance;

bool same(const std::vector<Sector>& a, const std::vector<Sector>& b, const Patches& patches) {
  const auto& patch = patches.triangle_patch;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Sector& s, const Sector& t) {
    return std::abs(s.from - t.from) < same_angle && std::abs(s.to - t.to) < same_angle &&
           patch[s.triangle0] == patch[t.triangle0] && patch[s.trianglen] == patch[t.trianglen];
  });
}

/// Where between the samples of two neighbouring cells the sectors stop to be those of the first.
double find_change(const EdgeSection& section, const Patches& patches, const Stretch& before, const Stretch& after) {
  double a = 0.5 * (before.from + before.to), b = 0.5 * (after.from + after.to);
  std::vector<Sector> sectors;
  while (b - a > change_width) {
    const double middle = 0.5 * (a + b);
    section.find_sectors(middle, least_angle, sectors);
    (same(before.sectors, sectors, patches) ? a : b) = middle;
  }
  const double middle = 0.5 * (a + b);
  const auto& breaks = section.breaks();  // from 0 to the length: `middle` lies within
  const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, middle);
  const double nearest = *above - middle < middle - *(above - 1) ? *above : *(above - 1);
  return std::abs(nearest - middle) <= change_width ? nearest : middle;
}

std::vector<Stretch> sample(const EdgeSection& section) {
  std::vector<Stretch> cells;
  const auto& breaks = section.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double size = breaks[i + 1] - breaks[i];
    const bool alone = !section.has_others(0.5 * (breaks[i] + breaks[i + 1]));
    const double parts = alone ? 1 : std::max(1.0, std::ceil(size / sample_step));
    for (double k = 0; k < parts; ++k) {
      Stretch cell{breaks[i] + size * (k / parts), breaks[i] + size * ((k + 1) / parts), {}, {}};
      section.find_sectors(0.5 * (cell.from + cell.to), least_angle, cell.sectors);
      for (const Sector& s : cell.sectors) {
        cell.triangles.push_back(s.triangle0);
        cell.triangles.push_back(s.trianglen);
      }
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

/// Appends `next` to `stretch`; the sectors stay those of `stretch`.
void absorb(Stretch& stretch, const Stretch& next) {
  stretch.from = std::min(stretch.from, next.from);
  stretch.to = std::max(stretch.to, next.to);
  stretch.triangles.insert(stretch.triangles.end(), next.triangles.begin(), next.triangles.end());
}

void unite_equal(std::vector<Stretch>& stretches, const Patches& patches) {
  std::vector<Stretch> united;
  double longest = 0;
  for (Stretch& next : stretches) {
    const double size = next.to - next.from;
    if (united.empty() || !same(united.back().sectors, next.sectors, patches)) {
      united.push_back(std::move(next));
      longest = size;
      continue;
    }
    absorb(united.back(), next);
    if (size > longest) {
      united.back().sectors = std::move(next.sectors);
      longest = size;
    }
  }
  stretches = std::move(united);
}

void drop_short(std::vector<Stretch>& stretches) {
  const auto size = [&](std::size_t i) { return stretches[i].to - stretches[i].from; };
  for (std::size_t i = 0; stretches.size() > 1 && i < stretches.size();) {
    if (size(i) >= least_stretch) {
      ++i;
      continue;
    }
    const bool into_next = i == 0 || (i + 1 < stretches.size() && size(i + 1) > size(i - 1));
    Stretch& other = stretches[into_next ? i + 1 : i - 1];
    other.from = std::min(other.from, stretches[i].from);
    other.to = std::max(other.to, stretches[i].to);
    stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(i));
    if (!into_next) --i;
  }
}

}  // namespace

std::vector<Stretch> find_stretches(EdgeSection& section, const Patches& patches) {
  section.look_around();
  std::vector<Stretch> stretches = sample(section);
  if (stretches.size() == 1) return stretches;
  for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
    Stretch &before = stretches[i], &after = stretches[i + 1];
    if (same(before.sectors, after.sectors, patches)) continue;
    const double place = find_change(section, patches, before, after);
    // The samples stay inside their cells: the change lies between them.
    before.to = after.from = place;
  }
  unite_equal(stretches, patches);
  drop_short(stretches);
  unite_equal(stretches, patches);
  return stretches;
}

}  // namespace grimaldi
