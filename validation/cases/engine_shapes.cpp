#include "validation/cases/engine_shapes.h"

#include <cmath>

#include "core/constants.h"
#include "scenes/shapes.h"

namespace grimaldi {
namespace {

constexpr Vec3 east{1, 0, 0}, north{0, 1, 0}, up{0, 0, 1};
constexpr double longest = 200;  // m: single precision keeps 12 µm over it

}  // namespace

SceneDescription upright_wedge(double n, double face, double half_height) {
  SceneDescription scene;
  scene.name = "upright wedge";
  MeshDescription mesh{"wedge", scene.name, "metal", {}, {}, {}};
  const std::vector<double> along = symmetric_cuts(half_height, longest), out = equal_cuts(0, face, longest);
  append_sheet(along, out, {}, up, east, {true, true, false, true}, mesh);
  if (n < 2) append_sheet(out, along, {}, {std::cos(n * pi), std::sin(n * pi), 0}, up, {false, true, true, true}, mesh);
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

SceneDescription deep_blocks(const std::vector<DeepBlock>& blocks, double depth, double half) {
  SceneDescription scene;
  scene.name = "deep blocks";
  const std::vector<double> along = symmetric_cuts(half, longest);
  for (const DeepBlock& block : blocks) {
    MeshDescription mesh{"block", scene.name, "metal", {}, {}, {}};
    const std::vector<double> down = equal_cuts(-depth, block.top, longest);
    append_sheet(equal_cuts(0, block.width, longest), along, {block.from, 0, block.top}, east, north,
                 {false, false, true, true}, mesh);
    append_sheet(down, along, {block.from, 0, 0}, up, north, {true, false, true, true}, mesh);
    append_sheet(along, down, {block.from + block.width, 0, 0}, north, up, {true, true, true, false}, mesh);
    scene.meshes.push_back(std::move(mesh));
  }
  return scene;
}

SceneDescription upright_plate(double wide, double high) {
  SceneDescription scene;
  scene.name = "plate";
  MeshDescription mesh{"plate", scene.name, "metal", {}, {}, {}};
  append_sheet(equal_cuts(-wide / 2, wide / 2, longest), equal_cuts(-high / 2, high / 2, longest), {}, north, up, {},
               mesh);
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

SceneDescription upright_screen_with_hole(double half, double wide, double high) {
  SceneDescription scene;
  scene.name = "screen with a hole";
  MeshDescription mesh{"screen", scene.name, "metal", {}, {}, {}};
  append_sheet({-half, -wide / 2, wide / 2, half}, {-half, -high / 2, high / 2, half}, {}, north, up,
               {true, true, true, true}, mesh);
  const auto middle = mesh.triangles.begin() + 8;  // two triangles a cell, three cells a row
  mesh.triangles.erase(middle, middle + 2);
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

SceneDescription closed_box(const Vec3& low, const Vec3& high) {
  SceneDescription scene;
  scene.name = "box";
  MeshDescription mesh{"box", scene.name, "metal", {}, {}, {}};
  const Vec3 size = high - low;
  const std::vector<double> x{0, size.x}, y{0, size.y}, z{0, size.z};
  append_sheet(y, x, low, north, east, {}, mesh);
  append_sheet(z, y, low, up, north, {}, mesh);
  append_sheet(x, z, low, east, up, {}, mesh);
  append_sheet(x, y, {low.x, low.y, high.z}, east, north, {}, mesh);
  append_sheet(y, z, {high.x, low.y, low.z}, north, up, {}, mesh);
  append_sheet(z, x, {low.x, high.y, low.z}, up, east, {}, mesh);
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

}  // namespace grimaldi
