#include "propagation/laws/slab_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

struct Slab {
  Complex permittivity;
  double thickness, wavenumber;
};

double largest_difference(const Slab& slab, const SlabTable& table) {
  double largest = 0;
  for (int i = 0; i <= 20011; ++i) {
    const double cosine = i / 20011.0;  // no node, no border of a piece but the ends
    const auto found = table(cosine),
               exact = slab_reflection(slab.permittivity, slab.thickness, slab.wavenumber, cosine);
    largest = std::max({largest, std::abs(found.te - exact.te), std::abs(found.tm - exact.tm)});
  }
  return largest;
}

// The table is checked at seven points of each piece when it is made; between them a polynomial of degree 5 that is
// right to 1e-10 there is right to twice that.
TEST(SlabTable, WallsOfCities) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Slab& slab :
       {Slab{{5.24, -0.46}, 0.1, 73.4}, Slab{{3.91, -0.1}, 0.3, 73.4}, Slab{{6.31, -0.1}, 0.006, 587},
        Slab{{1.99, -0.05}, 0.02, 1257}, Slab{{5.24, -0.46}, infinity, 73.4}}) {
    const SlabTable table(slab.permittivity, slab.thickness, slab.wavenumber);
    EXPECT_GT(table.pieces(), 0u) << slab.permittivity;
    EXPECT_LE(largest_difference(slab, table), 2e-10) << slab.permittivity;
  }
}

TEST(SlabTable, WhatIsTooSteepIsNotTabled) {
  // A conductor's coefficient turns within 1/|√η| of grazing incidence; thick clear glass has thousands of fringes.
  for (const Slab& slab : {Slab{{1, -5e7}, 0.1, 73.4}, Slab{{2.25, 0}, 100, 1257}}) {
    const SlabTable table(slab.permittivity, slab.thickness, slab.wavenumber);
    EXPECT_EQ(table.pieces(), 0u) << slab.permittivity;
    EXPECT_EQ(largest_difference(slab, table), 0) << slab.permittivity;
  }
}

}  // namespace
}  // namespace grimaldi
