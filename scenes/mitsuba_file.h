#pragma once
// Mitsuba/Sionna scenes: XML that names PLY meshes and their materials.

#include <filesystem>

#include "core/contract.h"
#include "scenes/description.h"

namespace grimaldi {

/// Reads <scene>: <bsdf type="itu-radio-material"> (type, thickness), <bsdf type="radio-material">
/// (relative_permittivity, conductivity, thickness), any other <bsdf> (possibly twosided, nested) whose id names the
/// material ("mat-itu_concrete"); <shape type="ply"|"obj"> with filename (relative to the XML), <ref name="bsdf"
/// id="…"/> or any <ref> to a bsdf, and to_world <transform>s (matrix, translate, rotate, scale, in order). <default
/// name= value=> with $name substitution. Cameras, integrators, emitters, samplers and films are passed over. Other
/// shapes (sphere, rectangle, cube …) and unknown elements: a warning each kind. Faults to `diagnostics` with file and
/// line: XML that does not parse, nesting deeper than 64, a reference to a bsdf or mesh that is not there, a matrix
/// without 16 numbers. A face winding is reversed by a mirroring transform. An itu-radio-material goes by the key of
/// its type; where a second one of the same type differs (glass of another thickness) it goes by its id, `based_on` the
/// type, with a warning. Scattering parameters: a warning if not zero. An unknown step of a transform and a matrix
/// whose last row is not 0 0 0 1 are errors: the mesh would lie wrongly.
SceneDescription read_mitsuba(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace grimaldi
