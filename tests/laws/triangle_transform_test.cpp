// The transform of a triangle against many digits, against the reference polygons, and against itself cut in two.

#include "propagation/laws/triangle_transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "tests/laws/fsd_rows.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

double area(const AmplitudeTriangle& t) {
  const auto& [a, b, c] = t.corner;
  return 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

// The bound of the header, as a share of |S| max|φ|.
double bound(const AmplitudeTriangle& t, const PlanePoint& kappa) {
  double reach = 0, high = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    reach = std::max(reach, std::hypot(t.corner[i][0], t.corner[i][1]));
    high = std::max(high, std::abs(t.amplitude[i]));
  }
  return (2e-15 + 4.5e-16 * std::hypot(kappa[0], kappa[1]) * reach) * area(t) * high;
}

struct Point {
  AmplitudeTriangle triangle;
  PlanePoint kappa;
  Complex value;
};
// mpmath 1.3, 60 digits: 2|S| Σ φ_j exp[z₁, z₂, z₃, z_j] by the power series of the divided difference to 400 terms, on
// the exact values of the doubles. Phases within 1e-9 … 45 of each other, on either side of 2; a needle; two equal
// phases; no κ; far from the origin.
const Point points[] = {
    {{{{{-0.0952, 0.1195}, {0.8484, -0.0687}, {0.0157, 0.1748}}},
      {{{-0.6307, 0.0238}, {0.2598, 0.586}, {-0.8118, -0.3932}}}},
     {1.2148807474914541e-09, 7.776911441707549e-10},
     {-0.014399857404712472942, 0.0026371938095610026677}},
    {{{{{0.6193, 0.3869}, {-0.9162, 0.9644}, {0.9295, 0.3078}}},
      {{{0.2311, -0.685}, {-0.97, 0.0568}, {-0.8809, -0.6196}}}},
     {0.000915850721062182, 0.01780442533637598},
     {-0.015681222553173540848, -0.011830916899609081531}},
    {{{{{-0.9398, -0.0721}, {-0.1189, 0.6849}, {0.0382, 0.2806}}},
      {{{-0.0005, 0.3249}, {-0.0853, -0.4437}, {0.9953, 0.9914}}}},
     {0.6281088585402509, -0.9926393725533679},
     {0.035840971951145917077, 0.08883081705462850239}},
    {{{{{0.4156, -0.3694}, {-0.5407, -0.4219}, {-0.8596, 0.5326}}},
      {{{-0.1992, 0.6932}, {-0.227, 0.9161}, {0.6946, -0.9989}}}},
     {0.44625918060857706, 1.7205993218397855},
     {-0.038417734121787409649, 0.056807135429641590643}},
    {{{{{0.8205, -0.06}, {0.9607, -0.2052}, {-0.8539, 0.2589}}},
      {{{0.557, -0.4604}, {-0.8257, -0.3348}, {0.9282, 0.5161}}}},
     {1.3669125903313013, 1.2505916535556545},
     {0.009027777390722757009, -0.0032826402453617550929}},
    {{{{{-0.5072, -0.7979}, {-0.8802, 0.594}, {-0.6446, 0.1186}}},
      {{{-0.1052, -0.6186}, {0.4638, -0.7381}, {0.2874, -0.767}}}},
     {-1.757890318148111, 0.95862268218317},
     {-0.04256908024685533437, -0.033880438999074671624}},
    {{{{{-0.5743, -0.4604}, {0.9419, 0.6068}, {-0.3917, 0.7697}}},
      {{{-0.5786, -0.2115}, {0.7088, 0.2837}, {-0.7993, 0.9786}}}},
     {0.3327321949678809, 1.4107116248029408},
     {0.001536174725489528963, 0.24270979909579810197}},
    {{{{{-0.4834, 0.5454}, {-0.3421, -0.4074}, {-0.8532, -0.8198}}},
      {{{0.1655, -0.514}, {0.2026, -0.2566}, {-0.0936, 0.9183}}}},
     {-4.699475022403542, 0.4895773131679191},
     {-0.030894095390748907926, -0.041998737054791867816}},
    {{{{{0.1491, 0.7331}, {-0.6343, -0.6917}, {0.8168, 0.6356}}},
      {{{-0.501, -0.6204}, {0.4788, 0.8808}, {-0.6068, 0.9003}}}},
     {3.961598269309336, -3.6393931854580157},
     {-0.045726178047998880665, 0.16392727186331840805}},
    {{{{{0.2071, -0.1571}, {-0.7923, -0.9226}, {0.9254, -0.5232}}},
      {{{0.4092, -0.486}, {0.6474, 0.1929}, {-0.4131, -0.6491}}}},
     {-1.297232380619165, -6.79757799975076},
     {-0.037582785953232951187, 0.1068563648875466901}},
    {{{{{-0.8624, -0.5432}, {0.1187, 0.7048}, {0.2286, -0.4396}}},
      {{{0.8347, -0.592}, {-0.9669, -0.4616}, {-0.1086, -0.8791}}}},
     {5.754758287169757, 11.501607888187301},
     {-0.0051259781824268960815, 0.011768751417789623184}},
    {{{{{-0.2624, 0.1443}, {-0.7368, -0.2757}, {0.7819, 0.961}}},
      {{{0.3139, 0.3824}, {0.1689, -0.7193}, {-0.9298, -0.9642}}}},
     {61.54690423181493, -39.194051473160286},
     {-0.000076876471803496013273, -0.000091957030163867557665}},
    {{{{{0.0, 0.0}, {1.0, 0.0}, {0.4, 1e-05}}}, {{{1.0, 0.0}, {-0.0, -1.0}, {0.5, 0.2}}}},
     {0.001, 300000.0},
     {4.3808695342569543036e-7, -2.6284054323259650793e-6}},
    {{{{{0.0, 0.0}, {1.0, 0.0}, {0.4, 1e-05}}}, {{{1.0, 0.0}, {-0.0, -1.0}, {0.5, 0.2}}}},
     {40.0, 10000.0},
     {-2.2023893868905744345e-8, -9.5747296442580331468e-9}},
    {{{{{0.25, 0.0}, {0.25, 1.0}, {-0.5, 0.5}}}, {{{1.0, 0.0}, {0.0, 0.25}, {-0.5, 0.0}}}},
     {24.0, 0.0},
     {-0.0064595213190497016449, 0.019449389363144369955}},
    {{{{{0.25, 0.0}, {0.25, 1.0}, {-0.5, 0.5}}}, {{{1.0, 0.0}, {0.0, 0.25}, {-0.5, 0.0}}}},
     {-24.0, 1e-07},
     {0.003858170153195558398, -0.021196191194663744607}},
    {{{{{0.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}}}, {{{1.0, 1.0}, {2.0, 0.0}, {0.0, 3.0}}}},
     {0.0, 0.0},
     {0.5, 0.66666666666666666667}},
    {{{{{30.5, -20.25}, {31.5, -20.25}, {30.5, -19.25}}}, {{{1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}}}},
     {1.7, 0.9},
     {-0.25520877622921657171, -0.20602847689701324469}},
};

TEST(TriangleTransform, AgainstManyDigits) {
  double worst = 0;
  for (const Point& p : points) {
    const double error = std::abs(triangle_transform(p.triangle, p.kappa) - p.value);
    EXPECT_LE(error, bound(p.triangle, p.kappa)) << p.kappa[0] << " " << p.kappa[1];
    worst = std::max(worst, error / bound(p.triangle, p.kappa));
  }
  std::printf("triangle transform: largest error %.2f of its bound\n", worst);
}

// 1e-12 of kAφ/2π is asked.
TEST(TriangleTransform, PolygonsOfTheReference) {
  const auto rows = fsd_rows();
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/fsd_vectors.csv";
  double worst = 0;
  for (const FsdRow& row : rows) {
    const Complex here = aperture_field(row.aperture, row.wavenumber, row.xi);
    const double error = std::abs(here - row.exact) / (row.wavenumber * row.area * row.highest / (2 * pi));
    EXPECT_LT(error, 1e-14) << row.id;
    worst = std::max(worst, error);
  }
  std::printf("fsd field: %zu rows, largest error %.1e of k A phi/2 pi\n", rows.size(), worst);
  EXPECT_GT(rows.size(), 150u);
}

AmplitudeTriangle random_triangle(std::uint64_t i) {
  const auto u = uniform4(8, 1, i, 0), v = uniform4(8, 1, i, 1), w = uniform4(8, 1, i, 2);
  return {{{{u[0], u[1]}, {u[2], u[3]}, {v[0], v[1]}}},
          {{{v[2] - 0.5, v[3]}, {w[0], w[1] - 0.5}, {w[2] - 0.5, w[3] - 0.5}}}};
}

// Cut from a corner to a point of the far side, where the amplitude is the linear one, both halves add up to the whole.
// The point is rounded by 1e-16, which changes the area as much.
TEST(TriangleTransform, HalvesAddUp) {
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const AmplitudeTriangle whole = random_triangle(i);
    const auto u = uniform4(8, 2, i, 0);
    const double share = u[0], size = std::pow(10.0, 6 * u[1] - 3);
    const PlanePoint kappa{size * std::cos(2 * pi * u[2]), size * std::sin(2 * pi * u[2])};
    AmplitudeTriangle first = whole, second = whole;
    PlanePoint cut;
    for (std::size_t x = 0; x < 2; ++x) cut[x] = whole.corner[1][x] + share * (whole.corner[2][x] - whole.corner[1][x]);
    const Complex between = whole.amplitude[1] + share * (whole.amplitude[2] - whole.amplitude[1]);
    first.corner[2] = cut, first.amplitude[2] = between;
    second.corner[1] = cut, second.amplitude[1] = between;
    const Complex sum = triangle_transform(first, kappa) + triangle_transform(second, kappa);
    EXPECT_LE(std::abs(sum - triangle_transform(whole, kappa)), 2 * bound(whole, kappa) + 1e-15) << i;
  }
}

// Order and winding of the corners do not count; a triangle without area gives nothing.
TEST(TriangleTransform, OrderOfCorners) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    const AmplitudeTriangle t = random_triangle(i);
    const PlanePoint kappa{0.05 * double(i), 3.0};
    const Complex value = triangle_transform(t, kappa);
    for (const auto& [a, b, c] : {std::array{1, 2, 0}, std::array{2, 1, 0}, std::array{0, 2, 1}}) {
      const auto at = [&](int n) { return static_cast<std::size_t>(n); };
      const AmplitudeTriangle other{{t.corner[at(a)], t.corner[at(b)], t.corner[at(c)]},
                                    {t.amplitude[at(a)], t.amplitude[at(b)], t.amplitude[at(c)]}};
      EXPECT_LE(std::abs(triangle_transform(other, kappa) - value), 2 * bound(t, kappa)) << i;
    }
  }
  EXPECT_EQ(triangle_transform({{{{0, 0}, {1, 1}, {2, 2}}}, {1, 1, 1}}, {3, -3}), Complex(0));
}

// At κ = 0 the integral is |S| times the mean amplitude; the transform of a real amplitude at −κ is the conjugate.
TEST(TriangleTransform, ValueAtZeroAndSymmetry) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    AmplitudeTriangle t = random_triangle(i);
    const Complex mean = (t.amplitude[0] + t.amplitude[1] + t.amplitude[2]) / 3.0;
    EXPECT_LE(std::abs(triangle_transform(t, {0, 0}) - area(t) * mean), bound(t, {0, 0}));
    for (Complex& a : t.amplitude) a = a.real();
    EXPECT_LE(std::abs(triangle_transform(t, {5, -8}) - std::conj(triangle_transform(t, {-5, 8}))),
              2 * bound(t, {5, 8}));
  }
}

// The same operations; compilers round a·b ± c once or twice as they pack them (g++ 12 does in spite of its option), so
// both have the bound, not the same bits.
// Needles, shifted and turned: at κ = 0 the transform is the area times the mean amplitude. Corners are whole multiples
// of 2^-40, so the area is exact in whole numbers. Bound: the header's.
TEST(TriangleTransform, NeedlesKeepTheirDigits) {
  __extension__ using Whole = __int128;
  constexpr double unit = 0x1p-40;
  for (int decade = 1; decade <= 11; ++decade)
    for (std::uint32_t trial = 0; trial < 40; ++trial) {
      const auto u = uniform4(5, 77, trial, static_cast<std::uint32_t>(decade));
      const double turn = 2 * pi * u[0], thin = std::pow(10.0, -decade), along = u[3];
      const PlanePoint from{2 * u[1] - 1, 2 * u[2] - 1};
      const auto on_grid = [&](double x, double y) {
        return PlanePoint{std::round((from[0] + std::cos(turn) * x - std::sin(turn) * y) / unit) * unit,
                          std::round((from[1] + std::sin(turn) * x + std::cos(turn) * y) / unit) * unit};
      };
      const AmplitudeTriangle t{{on_grid(0, 0), on_grid(1, 0), on_grid(along, thin)}, {1.0, 1.0, 1.0}};
      const auto whole = [&](std::size_t i, std::size_t axis) { return static_cast<Whole>(t.corner[i][axis] / unit); };
      const Whole twice = (whole(1, 0) - whole(0, 0)) * (whole(2, 1) - whole(0, 1)) -
                          (whole(1, 1) - whole(0, 1)) * (whole(2, 0) - whole(0, 0));
      const double exact = 0.5 * unit * unit * std::abs(static_cast<double>(twice));
      EXPECT_NEAR(triangle_transform(t, {0, 0}).real(), exact, 2e-15 * exact) << decade << " " << trial;
    }
}

TEST(TriangleTransform, ManyAtOnce) {
  std::vector<PlanePoint> kappa;
  for (std::uint64_t i = 0; i < 1003; ++i) {
    const auto u = uniform4(8, 3, i, 0);
    const double size = i < 200 ? 1e3 : std::pow(10.0, 5 * u[0] - 3);
    kappa.push_back({size * std::cos(2 * pi * u[1]), size * std::sin(2 * pi * u[1])});
  }
  std::vector<Complex> many(kappa.size());
  for (std::uint64_t n = 0; n < 5; ++n) {
    const AmplitudeTriangle t = random_triangle(n);
    triangle_transform(t, kappa, many);
    for (std::size_t i = 0; i < kappa.size(); ++i)
      EXPECT_LE(std::abs(many[i] - triangle_transform(t, kappa[i])), 2 * bound(t, kappa[i])) << i;
  }
}

}  // namespace
}  // namespace grimaldi
