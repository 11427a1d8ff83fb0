#pragma once
// The materials of Recommendation ITU-R P.2040, version by version.

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/material.h"

namespace grimaldi {

/// Version of the Recommendation, 1 (2015) … 4, from "P.2040-3" ("p2040-3" and "P.2040-3 (remark)" too); nothing if it
/// names none.
std::optional<int> p2040_version(std::string_view name);

/// Table 3 of P.2040-`version` by material_key: constants for radio alone. Version 2 has the values of version 3.
/// Ranges may overlap in version 4 (brick, glass, plywood, marble, floorboard) and touch at their ends: the range with
/// the lowest lower end wins, then that with the lowest upper end; ends belong to their range. Outside all of them the
/// nearest counts (relative_permittivity).
/// Inputs: version 1 … 4.
const std::map<std::string, Material>& p2040_materials(int version);

}  // namespace grimaldi
