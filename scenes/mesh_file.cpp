#include "scenes/mesh_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <set>
#include <string>
#include <utility>

#include "core/material.h"
#include "scenes/affine.h"
#include "scenes/file_contents.h"
#include "scenes/plain_gltf.h"
#include "scenes/plain_obj.h"

namespace grimaldi {
namespace {

// Where single precision begins to show: at 10 km its spacing is 1 mm, the wavelength of 300 GHz.
constexpr double far_out = 1e4;
// A mesh that many nodes place is copied for each. Fifty million triangles fill the memory of a large machine.
constexpr std::uint64_t most_triangles = 50'000'000;

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

// Leaves only the importers of the formats that are promised: assimp also looks into files for others.
void keep_promised_importers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* const info = importer.GetImporterInfo(i);
    const std::string endings = info == nullptr ? "" : std::string(" ") + info->mFileExtensions + " ";
    const bool kept = endings.find(" obj ") != std::string::npos || endings.find(" stl ") != std::string::npos ||
                      endings.find(" gltf ") != std::string::npos;
    if (kept) continue;
    Assimp::BaseImporter* const other = importer.GetImporter(i);
    importer.UnregisterLoader(other);  // no longer owned by `importer`
    delete other;
  }
}

Affine affine(const aiMatrix4x4& m) {
  return {{{{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}}}};
}

// Key of the material; empty if the file names none (assimp then makes one up).
std::string material_of(const aiScene& scene, const aiMesh& mesh) {
  aiString name;
  if (mesh.mMaterialIndex >= scene.mNumMaterials ||
      scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS) {
    return {};
  }
  const std::string text(name.C_Str());
  return text.empty() || text == AI_DEFAULT_MATERIAL_NAME ? std::string() : material_key(text);
}

struct Tally {
  double largest = 0;           // coordinate as assimp holds it, m
  std::uint64_t not_faces = 0;  // points and lines
  std::uint64_t triangles = 0;
};

MeshDescription described(const aiScene& scene, const aiMesh& mesh, const aiNode& node,
                          const std::filesystem::path& file, Tally& tally) {
  MeshDescription result;
  result.name = mesh.mName.length > 0 ? mesh.mName.C_Str() : node.mName.C_Str();
  if (result.name.empty()) result.name = file.stem().string();
  result.file = file.string();
  result.material = material_of(scene, mesh);
  result.vertices.reserve(mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    result.vertices.push_back({v.x, v.y, v.z});
    tally.largest = std::max({tally.largest, std::abs(double{v.x}), std::abs(double{v.y}), std::abs(double{v.z})});
  }
  result.triangles.reserve(mesh.mNumFaces);
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices == 3) {
      result.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    } else {
      ++tally.not_faces;
    }
  }
  return result;
}

// An error and false if the mesh cannot be used.
bool usable(const MeshDescription& mesh, Diagnostics& diagnostics) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index < mesh.vertices.size()) continue;
      diagnostics.error(mesh.file, 0, {}, "a face of mesh \"" + mesh.name + "\" names a vertex that is not there",
                        "vertex " + std::to_string(index) + " of " + std::to_string(mesh.vertices.size()),
                        "export the file again");
      return false;
    }
  }
  if (const std::size_t bad = first_not_finite(mesh); bad < mesh.vertices.size()) {
    diagnostics.error(mesh.file, 0, {},
                      "vertex " + std::to_string(bad) + " of mesh \"" + mesh.name + "\" is NaN or infinite",
                      "counted from 0 in the order of the faces", "repair the mesh");
    return false;
  }
  return true;
}

std::vector<MeshDescription> meshes_of(const aiScene& scene, const std::filesystem::path& file, const Affine& upright,
                                       Diagnostics& diagnostics) {
  std::vector<MeshDescription> meshes;
  Tally tally;
  std::set<std::string> faults;                        // names of meshes already reported
  std::vector<std::pair<const aiNode*, Affine>> open;  // nodes still to visit, with the map of what lies above them
  if (scene.mRootNode != nullptr) open.emplace_back(scene.mRootNode, upright);
  while (!open.empty()) {
    const auto [node, above] = open.back();
    open.pop_back();
    const Affine to_world = then(affine(node->mTransformation), above);
    // Reversed, so that meshes come in the order of the file.
    for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], to_world);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const aiMesh& source = *scene.mMeshes[node->mMeshes[i]];
      if ((tally.triangles += source.mNumFaces) > most_triangles) {
        diagnostics.error(file.string(), 0, {}, "too many triangles",
                          "more than " + std::to_string(most_triangles) + " in all its nodes",
                          "cut the scene into parts");
        return {};
      }
      MeshDescription mesh = described(scene, source, *node, file, tally);
      transform(mesh, to_world);
      if (faults.contains(mesh.name)) continue;
      if (!usable(mesh, diagnostics)) {
        faults.insert(mesh.name);
      } else if (!mesh.triangles.empty()) {
        meshes.push_back(std::move(mesh));
      }
    }
  }
  if (tally.not_faces > 0) {
    diagnostics.warning(file.string(), 0, {}, std::to_string(tally.not_faces) + " points or lines are passed over",
                        "they have no area");
  }
  if (meshes.empty() && faults.empty()) {
    diagnostics.warning(file.string(), 0, {}, "the file has no faces", "nothing for a wave to meet");
  }
  if (tally.largest > far_out && std::isfinite(tally.largest)) {
    const double loss = std::ldexp(tally.largest, -24);  // half the spacing of floats, relative 2⁻²⁴
    diagnostics.warning(
        file.string(), 0, {}, "coordinates up to " + std::to_string(tally.largest) + " m are kept in single precision",
        "they may be off by " + std::to_string(loss) + " m", "move the scene to its origin, or use PLY with doubles");
  }
  return meshes;
}

}  // namespace

std::vector<MeshDescription> read_with_assimp(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::string ending = lower_ending(file);
  const bool gltf = ending == ".gltf" || ending == ".glb";
  std::optional<std::string> contents = gltf ? plain_gltf(file, diagnostics) : read_file_contents(file, diagnostics);
  if (contents && ending == ".obj")
    contents = plain_obj(*contents, AI_DEFAULT_MATERIAL_NAME, file.string(), diagnostics);
  if (!contents) return {};
  Affine upright;
  if (gltf) upright.row = {{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};  // y up → z up
  std::string problem;
  try {
    Assimp::Importer importer;
    keep_promised_importers(importer);
    const char* const hint = gltf ? "glb" : ending == ".obj" ? "obj" : "stl";
    const aiScene* const scene =
        importer.ReadFileFromMemory(contents->data(), contents->size(), aiProcess_Triangulate, hint);
    if (scene != nullptr) return meshes_of(*scene, file, upright, diagnostics);
    problem = importer.GetErrorString();
  } catch (const std::exception& error) {
    problem = error.what();
  } catch (...) {
    problem = "unknown fault";
  }
  diagnostics.error(file.string(), 0, {}, "not a well-formed " + (ending.empty() ? "mesh" : ending.substr(1)) + " file",
                    problem, "export the file again");
  return {};
}

}  // namespace grimaldi
