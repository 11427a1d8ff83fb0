#include "propagation/plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/quantity.h"
#include "propagation/coverage_grid.h"
#include "propagation/edge_model.h"
#include "propagation/effort.h"
#include "propagation/result.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {
namespace {

/// What a material's law has to say at one band.
struct BandMessage {
  Diagnostic message;
  std::string band;
};

/// `text` without " at 3.5 GHz" or "3.5 GHz", whichever it has.
std::string without_band(std::string text, const std::string& band) {
  for (const std::string& words : {" at " + band, band})
    if (const auto place = text.find(words); place != std::string::npos) return text.erase(place, words.size());
  return text;
}

/// The parts of a suggestion between "; ".
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find("; ", begin)) != std::string::npos; begin = end + 2)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// One message of several that differ in the band and in the value used there: the bands listed, each value with its
/// band.
Diagnostic joined(const std::vector<BandMessage>& messages) {
  Diagnostic one = messages.front().message;
  if (messages.size() == 1) return one;
  std::string bands;
  for (const BandMessage& each : messages) bands += (bands.empty() ? "" : ", ") + each.band;
  const std::string& first = messages.front().band;
  if (const auto place = one.problem.find(first); place != std::string::npos)
    one.problem.replace(place, first.size(), bands);
  std::vector<std::string> parts = parts_of(one.suggestion);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string common = without_band(parts[i], first);
    std::string list;
    bool same = true;
    for (const BandMessage& each : messages) {
      const std::vector<std::string> other = parts_of(each.message.suggestion);
      const std::string text = i < other.size() ? without_band(other[i], each.band) : "";
      same = same && text == common;
      // "used: a at 1 GHz, used: b at 2 GHz" says "used:" once.
      const std::size_t colon = list.empty() ? std::string::npos : text.find(": ");
      list += (list.empty() ? "" : ", ") + (colon == std::string::npos ? text : text.substr(colon + 2)) + " at " +
              each.band;
    }
    parts[i] = same ? common : list;
  }
  one.suggestion = fmt::format("{}", fmt::join(parts, "; "));
  return one;
}

/// The materials at the plan's bands. What several bands of a material have in common is said once.
std::vector<FaceMaterial> face_materials(const Plan& plan, const Scene& scene, Diagnostics& diagnostics) {
  std::vector<FaceMaterial> faces;
  for (const Material& material : scene.materials) {
    FaceMaterial& face = faces.emplace_back();
    face.thickness = material.thickness;
    std::vector<std::vector<BandMessage>> groups;
    for (const double frequency : plan.frequency) {
      Diagnostics heard;
      if (plan.request.kind == WaveKind::radio) {
        face.permittivity.push_back(relative_permittivity(material, frequency, heard));
        face.slab.emplace_back(face.permittivity.back(), face.thickness, 2 * pi * frequency / plan.speed);
      } else
        face.absorption.push_back(absorption_coefficient(material, frequency, heard));
      const std::string band = format_frequency(frequency);
      for (const Diagnostic& message : heard.all()) {
        const auto like = [&](const std::vector<BandMessage>& group) {
          const auto& [other, other_band] = group.front();
          return other.severity == message.severity && other.why == message.why &&
                 without_band(other.problem, other_band) == without_band(message.problem, band);
        };
        auto group = std::find_if(groups.begin(), groups.end(), like);
        if (group == groups.end()) group = groups.emplace(groups.end());
        group->push_back({message, band});
      }
    }
    for (const auto& group : groups) diagnostics.add(joined(group));
  }
  return faces;
}

GridLayout grid_layout(const CoverageRequest& coverage, const Scene& scene, std::size_t bytes_per_cell,
                       Diagnostics& diagnostics) {
  const std::array<double, 4> area =
      coverage.area.value_or(std::array{scene.low.x, scene.low.y, scene.high.x, scene.high.y});
  const double width = area[2] - area[0], height = area[3] - area[1];
  GridLayout grid;
  grid.cell = coverage.cell_size;
  grid.z = scene.ground + coverage.height;
  if (!(width > 0 && height > 0)) {
    diagnostics.error("", 0, "coverage.area", "the area is empty", fmt::format("{:g} m × {:g} m", width, height),
                      "give area = [xmin, ymin, xmax, ymax] with xmin < xmax and ymin < ymax");
    return grid;
  }
  // A size that is a whole number of cells but for rounding gets that number.
  const double nx = std::ceil(width / grid.cell * (1 - 1e-12)), ny = std::ceil(height / grid.cell * (1 - 1e-12));
  const double needed = nx * ny * double(bytes_per_cell), limit = memory_limit();
  if (!(needed <= limit)) {
    // The product of the sides and of the cells may be no double any more.
    const double fitting = std::sqrt(width) * std::sqrt(height) * std::sqrt(double(bytes_per_cell) / limit);
    diagnostics.error(
        "", 0, "coverage.cell_size", "the grid cannot fit in memory",
        fmt::format("{:.7g} × {:.7g} cells need {:.3g} GB, {:.3g} GB may be used", nx, ny, needed / 1e9, limit / 1e9),
        fmt::format("use cells of {:.3g} m or more, or a smaller coverage.area", fitting * 1.01));
    return grid;
  }
  grid.nx = static_cast<std::size_t>(nx);
  grid.ny = static_cast<std::size_t>(ny);
  grid.x0 = 0.5 * (area[0] + area[2]) - 0.5 * nx * grid.cell;
  grid.y0 = 0.5 * (area[1] + area[3]) - 0.5 * ny * grid.cell;
  return grid;
}

std::string point_text(const Vec3& p) { return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z); }

/// Those that are small against some legs within the scene and its ends.
SmallObjects small_objects(const Plan& plan, const Scene& scene) {
  if (plan.wavenumber.empty()) return {};
  double reach = distance(scene.low, scene.high);
  for (const Transmitter& transmitter : plan.request.transmitters)
    if (is_finite(transmitter.position)) reach += distance(transmitter.position, 0.5 * (scene.low + scene.high));
  for (const Receiver& receiver : plan.request.receivers)
    if (is_finite(receiver.position)) reach += distance(receiver.position, 0.5 * (scene.low + scene.high));
  return find_small_objects(scene, largest_small_diameter(reach, 2 * pi / plan.wavenumber.front()));
}

}  // namespace

double memory_limit() { return 0.75 * double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)); }

Plan make_plan(const PlanDescription& description, const Scene& scene, const Tracer& tracer, Diagnostics& diagnostics) {
  Plan plan;
  const std::string file = description.scenario_file.string();
  plan.request = description;
  plan.speed = wave_speed(description.kind, description.air);
  plan.frequency = description.frequency;
  std::sort(plan.frequency.begin(), plan.frequency.end());
  for (const double f : plan.frequency) {
    plan.wavenumber.push_back(2 * pi * f / plan.speed);
    plan.attenuation.push_back(description.kind == WaveKind::acoustic
                                   ? sound_attenuation(description.air, f) / (20 * std::log10(std::exp(1.0)))
                                   : 0);
  }
  plan.materials = face_materials(plan, scene, diagnostics);
  if (description.diffraction && description.diffraction_model == DiffractionModel::automatic)
    plan.small_objects = small_objects(plan, scene);
  if (description.coverage && std::isfinite(description.coverage->cell_size)) {
    const Effort effort = effort_of(description);
    const double sub_points =
        sub_points_a_side * sub_points_a_side + std::pow(effort.coarse_points, 2) + std::pow(effort.dense_points, 2);
    // Layers, gain, error, bias and delays per transmitter and band; the sub-points; the walk's bookkeeping.
    const std::size_t bytes =
        description.transmitters.size() * plan.bands() * (mechanism_count + edge_model_count + 5) * sizeof(double) +
        static_cast<std::size_t>(sub_points) * sizeof(SubPoint) + 64;
    plan.grid = grid_layout(*description.coverage, scene, bytes, diagnostics);
  }
  for (const Transmitter& transmitter : description.transmitters) {
    if (!is_finite(transmitter.position)) continue;  // its fault has been told
    const std::string option = "transmitter." + transmitter.name + ".position";
    if (tracer.inside_solid(transmitter.position))
      diagnostics.error(
          file, 0, option, "the transmitter is inside a solid",
          fmt::format("an odd number of surfaces lies straight above {}", point_text(transmitter.position)),
          "move it out of the building, for instance above the roof");
    else if (transmitter.position.z < scene.ground)
      diagnostics.warning(
          file, 0, option, "the transmitter is below the ground",
          fmt::format("z = {:g} m, the lowest surface is at {:g} m", transmitter.position.z, scene.ground));
  }
  if (description.diffraction && description.diffraction_model == DiffractionModel::fsd_published &&
      !description.receivers.empty())
    diagnostics.error(description.scenario_file.string(), 0, "propagation.diffraction",
                      "fsd-published has no point receivers in this version",
                      "the published method is sampled over the cells of a map; it has no closed form at a point",
                      "leave the receivers out, or use diffraction = \"fsd\"");
  for (const Receiver& receiver : description.receivers) {
    if (!is_finite(receiver.position)) continue;
    const std::string option = "receiver." + receiver.name + ".position";
    if (tracer.inside_solid(receiver.position))
      diagnostics.warning(
          file, 0, option, "the receiver is inside a solid",
          fmt::format("an odd number of surfaces lies straight above {}", point_text(receiver.position)));
    else if (receiver.position.z < scene.ground)
      diagnostics.warning(
          file, 0, option, "the receiver is below the ground",
          fmt::format("z = {:g} m, the lowest surface is at {:g} m", receiver.position.z, scene.ground));
  }
  return plan;
}

int most_edges(const PlanDescription& request) {
  return request.diffraction ? std::min({request.depth, request.max_diffractions, static_cast<int>(max_edges)}) : 0;
}

}  // namespace grimaldi
