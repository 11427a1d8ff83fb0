#include "propagation/plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/coverage_grid.h"
#include "propagation/result.h"
#include "propagation/tracer.h"

namespace grimaldi {
namespace {

/// The materials at the plan's bands. Each is asked once per band, so that a warning comes once.
std::vector<FaceMaterial> face_materials(const Plan& plan, const Scene& scene, Diagnostics& diagnostics) {
  std::vector<FaceMaterial> faces;
  for (const Material& material : scene.materials) {
    FaceMaterial& face = faces.emplace_back();
    face.thickness = material.thickness;
    for (const double frequency : plan.frequency) {
      if (plan.request.kind == WaveKind::radio)
        face.permittivity.push_back(relative_permittivity(material, frequency, diagnostics));
      else
        face.absorption.push_back(absorption_coefficient(material, frequency, diagnostics));
    }
  }
  return faces;
}

GridLayout grid_layout(const CoverageRequest& coverage, const Scene& scene, std::size_t bytes_per_cell, Diagnostics& diagnostics) {
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
  if (needed > limit) {
    const double fitting = grid.cell * std::sqrt(needed / limit);
    diagnostics.error("", 0, "coverage.cell_size", "the grid cannot fit in memory",
                      fmt::format("{:.0f} × {:.0f} cells need {:.3g} GB, {:.3g} GB may be used", nx, ny, needed / 1e9, limit / 1e9),
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

}  // namespace

double memory_limit() {
  return 0.75 * double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
}

Plan make_plan(const PlanDescription& description, const Scene& scene, const Tracer& tracer, Diagnostics& diagnostics) {
  Plan plan;
  plan.request = description;
  plan.speed = wave_speed(description.kind, description.air);
  plan.frequency = description.frequency;
  std::sort(plan.frequency.begin(), plan.frequency.end());
  for (const double f : plan.frequency) {
    plan.wavenumber.push_back(2 * pi * f / plan.speed);
    plan.attenuation.push_back(
        description.kind == WaveKind::acoustic ? sound_attenuation(description.air, f) / (20 * std::log10(std::exp(1.0))) : 0);
  }
  plan.materials = face_materials(plan, scene, diagnostics);
  if (description.coverage) {
    const double sub_points = std::pow(sub_points_a_side(description.rays), 2) + std::pow(edge_sub_points_a_side(description.rays), 2);
    // Layers, gain, error, bias and delays per transmitter and band; the sub-points; the walk's bookkeeping.
    const std::size_t bytes = description.transmitters.size() * plan.bands() * (mechanism_count + 5) * sizeof(double) +
                              static_cast<std::size_t>(sub_points) * sizeof(SubPoint) + 64;
    plan.grid = grid_layout(*description.coverage, scene, bytes, diagnostics);
  }
  for (const Transmitter& transmitter : description.transmitters) {
    const std::string option = "transmitter." + transmitter.name + ".position";
    if (tracer.inside_solid(transmitter.position))
      diagnostics.error("", 0, option, "the transmitter is inside a solid",
                        fmt::format("an odd number of surfaces lies straight above {}", point_text(transmitter.position)),
                        "move it out of the building, for instance above the roof");
    else if (transmitter.position.z < scene.ground)
      diagnostics.warning("", 0, option, "the transmitter is below the ground",
                          fmt::format("z = {:g} m, the lowest surface is at {:g} m", transmitter.position.z, scene.ground));
  }
  for (const Receiver& receiver : description.receivers) {
    const std::string option = "receiver." + receiver.name + ".position";
    if (tracer.inside_solid(receiver.position))
      diagnostics.warning("", 0, option, "the receiver is inside a solid",
                          fmt::format("an odd number of surfaces lies straight above {}", point_text(receiver.position)));
    else if (receiver.position.z < scene.ground)
      diagnostics.warning("", 0, option, "the receiver is below the ground",
                          fmt::format("z = {:g} m, the lowest surface is at {:g} m", receiver.position.z, scene.ground));
  }
  return plan;
}

}  // namespace grimaldi
