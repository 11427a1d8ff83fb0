#pragma once
// The city that comes with the program: a quarter by formula, the same bits on every machine.

#include <vector>

#include "core/vector.h"
#include "scenes/description.h"
#include "scenes/shapes.h"

namespace grimaldi {

/// An invented quarter on 600 m × 600 m, |x|, |y| ≤ 300, x east, y north, ground at z = 0 that reaches 50 m beyond:
///
/// * Blocks A … F from west to east, 1 … 6 from south to north, 52 to 124 m a side; streets of 12 m and more between.
/// * A square of 80 m, |x|, |y| < 40, free of buildings: a town hall (D4) on its north, a tower of 90 m (E2) at its
///   south-east corner.
/// * An avenue of 24 m, |4 y − 3 x| < 60, cuts the grid from south-west to north-east through the square.
/// * A street canyon along y, 228 < x < 240, between houses of 25 m on either side, 118 m and 120 m long (F1, F2).
/// * Closed courtyards (A3, B4, C5, D5, B6, and along the avenue), courtyards reached by a passage of 6 m (C1, C4, D1,
///   D2, E1, E5, F3), L- and U-shapes, rows of houses with gabled roofs (A5, A6, E1, F1, F2).
/// * Eaves at 8 … 32 m by an integer hash of the building's number, higher near the square; the tower alone is higher.
///
/// Meshes: "ground" (concrete), then for each building "NAME walls" (brick, concrete, marble, glass or wood) and
/// "NAME roof" (concrete or metal). NAME is the block and a number, e.g. "B5 2". Buildings have outward normals and no
/// floor; at least 3 m lie between any two, at least 12 m between those of different blocks. The rim of the ground is
/// artificial.
///
/// Arithmetic is +, −, ×, ÷ and square root of doubles alone, which IEEE 754 fixes to the last bit.
SceneDescription demo_city();

/// The buildings of `demo_city`, in the order of its meshes.
std::vector<Building> demo_city_buildings();

/// A good place for a transmitter: 3 m above the flat roof (23 m) of the house west of the square, 1 m behind the edge
/// of its façade on the square. Local m.
inline constexpr Vec3 demo_city_rooftop{-41, 8, 26};

/// Another, on a mast in the middle of the square, below the roofs. (0, 0, z) is free for every z > 0.
inline constexpr Vec3 demo_city_mast{0, 0, 10};

}  // namespace grimaldi
