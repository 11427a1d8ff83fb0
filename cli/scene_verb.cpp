#include "cli/scene_verb.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/messages.h"
#include "cli/scene_request.h"

namespace grimaldi {
namespace {

using Json = nlohmann::ordered_json;

struct MaterialTally {
  double area = 0;  // m²
  std::size_t triangles = 0;
};

std::vector<MaterialTally> tally_materials(const Scene& scene) {
  std::vector<MaterialTally> tallies(scene.materials.size());
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const auto& [a, b, c] = scene.triangles[i];
    MaterialTally& tally = tallies[scene.triangle_material[i]];
    tally.area += norm(cross(scene.vertices[b] - scene.vertices[a], scene.vertices[c] - scene.vertices[a])) / 2;
    ++tally.triangles;
  }
  return tallies;
}

EdgeTally all_wedges(const WedgeReport& report) {
  return {report.within_material.count + report.across_materials.count,
          report.within_material.length + report.across_materials.length};
}

Json tally_json(const EdgeTally& tally) { return {{"count", tally.count}, {"length_m", tally.length}}; }

std::string row(const std::string& title, const std::string& text) { return fmt::format("{:<14}{}\n", title, text); }

std::string edge_row(const std::string& title, const EdgeTally& tally, const std::string& meaning) {
  return row(title, fmt::format("{:>8}  {:>12.1f} m  {}", tally.count, tally.length, meaning));
}

}  // namespace

std::string scene_json(const Scene& scene, const std::vector<Diagnostic>& warnings) {
  const WedgeReport& report = scene.wedges.report;
  const std::vector<MaterialTally> tallies = tally_materials(scene);
  Json json;
  json["name"] = scene.name;
  json["triangles"] = scene.triangles.size();
  json["vertices"] = scene.vertices.size();
  json["patches"] = scene.patches.patches.size();
  json["extent"] = {{scene.low.x, scene.low.y, scene.low.z}, {scene.high.x, scene.high.y, scene.high.z}};
  json["ground"] = scene.ground;
  json["materials"] = Json::array();
  for (std::size_t m = 0; m < tallies.size(); ++m)
    json["materials"].push_back(
        {{"name", scene.materials[m].name}, {"area_m2", tallies[m].area}, {"triangles", tallies[m].triangles}});
  json["wedges"] = tally_json(all_wedges(report));
  json["wedges"]["within_material"] = tally_json(report.within_material);
  json["wedges"]["across_materials"] = tally_json(report.across_materials);
  json["free"] = tally_json(report.free_rims);
  json["open_rims"] = {{"count", scene.open_rims.count}, {"length_m", scene.open_rims.length}};
  json["concave"] = tally_json(report.concave);
  json["filled"] = tally_json(report.filled);
  json["propagating"] = tally_json(report.propagating);
  json["defects"] = {{"degenerate", scene.defects.degenerate},
                     {"duplicate", scene.defects.duplicate},
                     {"non_manifold_edges", scene.defects.non_manifold_edges},
                     {"holes", scene.defects.holes},
                     {"flipped", scene.defects.flipped}};
  json["warnings"] = Json::array();
  for (const auto& warning : warnings) json["warnings"].push_back(to_string(warning));
  // Names in a file need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scene_table(const Scene& scene) {
  const WedgeReport& report = scene.wedges.report;
  const Vec3 size = scene.high - scene.low;
  std::string text = row("scene", scene.name);
  text += row("triangles", fmt::format("{}, {} vertices, {} flat patches", scene.triangles.size(),
                                       scene.vertices.size(), scene.patches.patches.size()));
  text += row("extent",
              fmt::format("x {:.2f} … {:.2f} m, y {:.2f} … {:.2f} m, z {:.2f} … {:.2f} m ({:.1f} × {:.1f} × {:.1f} m)",
                          scene.low.x, scene.high.x, scene.low.y, scene.high.y, scene.low.z, scene.high.z, size.x,
                          size.y, size.z));
  text += row("ground", fmt::format("{:.2f} m", scene.ground));
  const std::vector<MaterialTally> tallies = tally_materials(scene);
  for (std::size_t m = 0; m < tallies.size(); ++m)
    text += row(m == 0 ? "materials" : "", fmt::format("{:<20} {:>12.1f} m²  {:>8} triangles", scene.materials[m].name,
                                                       tallies[m].area, tallies[m].triangles));
  text += edge_row("wedges", all_wedges(report), "edges of two faces, exterior angle above 185°");
  text += edge_row("  within", report.within_material, "between faces of one material");
  text += edge_row("  across", report.across_materials, "between two materials");
  text += edge_row("free", report.free_rims, "rims of open surfaces");
  text += edge_row("open rims", {scene.open_rims.count, scene.open_rims.length},
                   "chains of free rims, feet of solids left out");
  text += edge_row("concave", report.concave, "inner corners: no diffraction");
  text += edge_row("filled", report.filled, "of the wedges: touch another solid");
  text += edge_row("propagating", report.propagating, "edges that diffract in a run");
  const Defects& defects = scene.defects;
  text += row(
      "defects",
      fmt::format("{} degenerate, {} duplicate, {} flipped triangles; {} edges of more than two; {} boundary loops",
                  defects.degenerate, defects.duplicate, defects.flipped, defects.non_manifold_edges, defects.holes));
  return text;
}

int scene_verb(const Arguments& arguments) {
  Diagnostics diagnostics;
  const PlanDescription request = read_scene_request(arguments.input, arguments.options, diagnostics);
  const Scene scene = make_scene(request, diagnostics);
  diagnostics.throw_if_errors();
  const std::vector<Diagnostic> warnings = warnings_of(diagnostics);
  if (!arguments.quiet) print_rest(warnings, print_warnings(warnings, 0), "grimaldi scene --json");
  fmt::print("{}", arguments.json ? scene_json(scene, warnings) : scene_table(scene));
  return 0;
}

}  // namespace grimaldi
