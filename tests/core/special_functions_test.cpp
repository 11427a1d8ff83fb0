#include "core/special_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/constants.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

double relative_error(Complex value, Complex truth) {
  return std::abs(value - truth) / std::abs(truth);
}

// The bound that the header states. The doubles of a truth are themselves off by 1e-16, which does not count beside it.
constexpr double bound = 1e-14;

// The numbers below come from mpmath 1.3 with 50 digits and more: exp(-z*z)*erfc(-1j*z),
// exp(1j*t*t)*erfc(exp(1j*pi/4)*t) and erfc(exp(1j*pi/4)*sqrt(pi/2)*v)/2, 20 digits printed, arguments the exact
// doubles shown.
struct PlanePoint {
  double x, y, re, im;
};
constexpr PlanePoint plane[] = {
    {0, 0.5, 0.61569034419292587487, 0.0},
    {0, 2, 0.25539567631050574387, 0.0},
    {0, 10, 0.056140992743822585858, 0.0},
    {0.1, 0.0, 0.99004983374916805247, 0.11208866436449538651},
    {1, 0, 0.3678794411714423216, 0.60715770584139372912},
    {3, 0, 0.0001234098040866795495, 0.20115731703760038666},
    {0.5116633539732443, 0.001, 0.7690351361453459985, 0.48560359635836063096},
    {0.2558316769866221, 0.001, 0.93565988082023071089, 0.27592426687099593897},
    {1, 1, 0.30474420525691259246, 0.20821893820283162729},
    {2, 0.25, 0.068263489270667900876, 0.31570766271099417898},
    {2.5, 1e-06, 0.0019305843721614727587, 0.25172301495951303525},
    {5, 0.01, 0.00024080339195117516647, 0.11524544620269498306},
    {6.3, 0.001, 0.000014789344514165287504, 0.090727657238914097558},
    {6, 6, 0.047335271133396014099, 0.046682744869731973312},
    {6.2, 6.1, 0.045797642521503017073, 0.045937207761372819495},
    {4, 7, 0.060741489333449160767, 0.034187756510083269651},
    {10, 0.001, 5.7287175028417533439e-6, 0.056705393651106210677},
    {12, 3, 0.011163889644607902579, 0.044361237994963507751},
    {0.001, 6.2, 0.089858106121106024327, 0.000014138623592625615001},
    {1e-10, 1e-12, 0.99999999999887162082, 1.128379167093512615e-10},
    {15, 15, 0.018827145325136756457, 0.018785354277995646774},
};

struct RayPoint {
  double t, re, im;
};
constexpr RayPoint ray[] = {
    {0.0, 1.0, 0.0},
    {1e-09, 0.9999999992021154392, -7.9788455980286540611e-10},
    {0.0625, 0.95025465227443460787, -0.046091205869042156402},
    {0.125, 0.90118773837250259733, -0.085143595976272837079},
    {0.3, 0.77145275953442261921, -0.16331868709631736065},
    {1.0, 0.41558809590784866125, -0.23031978755491063968},
    {2.25, 0.1889049044415858078, -0.15742789178947435733},
    {4.9, 0.082997144687651277958, -0.079627680559013277529},
    {8.0, 0.050247910123832196575, -0.049469436627348564495},
    {11.999, 0.033362200937195677781, -0.03313131557922580246},
    {12.0, 0.033359401923252848987, -0.033128574267913499605},
    {12.4, 0.032276347797330570849, -0.032067140819854453383},
    {20.0, 0.019971953831281766343, -0.01992208721489277366},
    {30.0, 0.0133054514862859792, -0.01329067591467552208},
};
constexpr RayPoint knife[] = {
    {-7.3, 1.0291076717583033865, 0.010160343900159095784},
    {-0.5, 0.77853832936572283525, 0.21380589650572355763},
    {0.25, 0.37103262470383953038, -0.12079177506038271384},
    {1.0, -0.10907627388358879778, -0.1708171264932340317},
    {3.7, -0.058463006020980159737, 0.016517343866492746836},
    {40.0, 0.0039796646761407189705, -0.0039780815335861838457},
    {1000.1, 0.00015661980079676666853, -0.00016161899399753503136},
    {123456.789, -8.5178023827158567445e-7, 1.6119280119071093108e-6},
    {98765432.1, -2.0808685517567366608e-9, -9.2924071348440226535e-10},
};

TEST(SpecialFunctions, FaddeevaOfTheUpperHalfPlane) {
  for (const PlanePoint& p : plane) {
    const Complex truth{p.re, p.im};
    EXPECT_LT(relative_error(faddeeva({p.x, p.y}), truth), bound) << p.x << " + j" << p.y;
    EXPECT_LT(relative_error(faddeeva({-p.x, p.y}), std::conj(truth)), bound) << -p.x << " + j" << p.y;
  }
}

TEST(SpecialFunctions, FaddeevaOfTheLowerHalfPlane) {
  // mpmath as above. The exponential is multiplied by up to e^{3.75}, its exponent rounds by 4 ulp.
  EXPECT_LT(relative_error(faddeeva({1, -1}), {-1.1370378783511973665, 2.0268137918541950181}), bound);
  EXPECT_LT(relative_error(faddeeva({-0.5, -2}), {-35.635303512001889054, -77.380142375345434942}), bound);
  EXPECT_LT(relative_error(faddeeva({3, -0.25}), {-0.019373630131790134936, 0.19916015896435768638}), bound);
  EXPECT_TRUE(std::isinf(std::abs(faddeeva({1, -30}))));  // |w| = e^{899}
}

TEST(SpecialFunctions, FaddeevaOnTheAxes) {
  for (double a = 0; a < 26; a += 0.0625) {
    // On the real axis Re w = e^{−x²}; the exponent x² < 676 rounds by 1e-13 at the most, which the exponential shows.
    EXPECT_NEAR(faddeeva({a, 0}).real(), std::exp(-a * a), (1e-14 + 2e-16 * a * a) * std::exp(-a * a));
    EXPECT_EQ(faddeeva({0, a}).imag(), 0);
    // On the imaginary axis w = e^{y²} erfc(y); erfc of the library and the exponential of y² ≤ 25 round.
    if (a < 5) {
      EXPECT_NEAR(faddeeva({0, a}).real() / (std::exp(a * a) * std::erfc(a)), 1.0, 2e-14);
    }
  }
}

TEST(SpecialFunctions, FaddeevaJoinsAtTheSeamsOfItsMethod) {
  // The rules change at x = y, at y = π/h and at quarters of the step h; the function does not. Steps of 1e-9 change w
  // by |w'| 1e-9 ≤ (2|z| + 2)e-9 (w' = −2zw + 2j/√π), here compared with the derivative taken out.
  const double h = std::sqrt(pi / 12);
  const auto jump = [](Complex z, Complex step) {
    const Complex slope = -2.0 * z * faddeeva(z) + Complex{0, 2 / std::sqrt(pi)};
    return std::abs(faddeeva(z + step) - faddeeva(z - step) - 2.0 * step * slope) / std::abs(faddeeva(z));
  };
  for (double a = 0.05; a < 9; a += 0.05) {
    EXPECT_LT(jump({a, a}, {1e-9, 0}), bound) << a;
    EXPECT_LT(jump({a, pi / h}, {0, 1e-9}), bound) << a;
    for (int quarter = 1; quarter < 60; quarter += 2)
      EXPECT_LT(jump({quarter * h / 4, a}, {1e-9, 0}), bound) << quarter;
  }
}

TEST(SpecialFunctions, FaddeevaOfHugeAndTinyArguments) {
  for (const double y : {0.0, 1e-300, 1.0, 1e200, 1e308}) {
    const Complex z{1e300, y};
    // w → j/(√π z), here written out without overflow.
    const double s = std::fmax(1e300, y), a = 1e300 / s, b = y / s, scale = 1 / (std::sqrt(pi) * s * (a * a + b * b));
    EXPECT_LT(relative_error(faddeeva(z), {scale * b, scale * a}), bound);
  }
  EXPECT_EQ(faddeeva({0, 0}), Complex(1, 0));
  EXPECT_LT(std::abs(faddeeva({1e-300, 1e-300}) - 1.0), 1e-15);
}

TEST(SpecialFunctions, RayAgainstManyDigits) {
  for (const RayPoint& p : ray) EXPECT_LT(relative_error(faddeeva_on_ray(p.t), {p.re, p.im}), bound) << p.t;
}

TEST(SpecialFunctions, RayIsTheFaddeevaFunctionThere) {
  const Complex direction = std::polar(1.0, 3 * pi / 4);
  for (double t = 0; t < 40; t += 0.0078125)  // two methods, each with its bound
    EXPECT_LT(relative_error(faddeeva_on_ray(t), faddeeva(direction * t)), 2 * bound) << t;
}

TEST(SpecialFunctions, RayIsContinuousWhereItsTablesMeet) {
  for (int i = 1; i <= 96; ++i) {
    const double t = i / 8.0;
    const double before = std::nextafter(t, 0.0);  // one ulp of t changes the value by less than one ulp
    EXPECT_LT(relative_error(faddeeva_on_ray(before), faddeeva_on_ray(t)), 1e-15) << t;
  }
}

TEST(SpecialFunctions, RayFarOut) {
  // √π e^{jπ/4} t G(t) = 1 + j/(2t²) − …; at 1e8 the second term is 5e-17.
  for (const double t : {1e8, 1e100, 1e200, 1e307})
    EXPECT_LT(std::abs(std::sqrt(pi) * std::polar(1.0, pi / 4) * t * faddeeva_on_ray(t) - 1.0), 1e-15);
  EXPECT_EQ(faddeeva_on_ray(std::numeric_limits<double>::infinity()), Complex(0, 0));
}

TEST(SpecialFunctions, TransitionFunctionOfTheReference) {
  const auto rows = reference_rows("radio/utd_transition_F.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/utd_transition_F.csv";
  double worst = 0;
  for (const auto& row : rows)
    worst = std::fmax(worst,
                      relative_error(transition_function(std::stod(row[1])), {std::stod(row[2]), std::stod(row[3])}));
  RecordProperty("worst_relative_error", std::to_string(worst * 1e16) + "e-16");
  EXPECT_LT(worst, bound);
  EXPECT_GT(rows.size(), 60u);
}

TEST(SpecialFunctions, SpansGiveTheSameBits) {
  std::vector<double> t;
  for (double x = 1e-9; x < 1e9; x *= 1.037) t.push_back(x);
  t.insert(t.end(), {0.0, 11.99999, 12.0, 1e300, std::numeric_limits<double>::infinity()});
  std::vector<Complex> w(t.size()), f(t.size());
  faddeeva_on_ray(t, w);
  transition_function(t, f);
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_EQ(w[i], faddeeva_on_ray(t[i])) << t[i];
    EXPECT_EQ(f[i], transition_function(t[i])) << t[i];
  }
}

TEST(SpecialFunctions, TransitionFunctionLimits) {
  EXPECT_EQ(transition_function(0), Complex(0, 0));
  EXPECT_EQ(transition_function(std::numeric_limits<double>::infinity()), Complex(1, 0));
  // F → (√(πx) − 2x e^{jπ/4}) e^{j(π/4 + x)} for small x (Kouyoumjian & Pathak, equation (28)); the next term is x^1.5.
  const double x = 1e-10;
  const Complex small = (std::sqrt(pi * x) - 2 * x * std::polar(1.0, pi / 4)) * std::polar(1.0, pi / 4 + x);
  EXPECT_LT(relative_error(transition_function(x), small), 3e-10);
  // F → 1 + j/(2x) − 3/(4x²) − j 15/(8x³) + 75/(16x⁴) for large x (equation (29), with 105/16 for its misprinted
  // 75/16).
  const double y = 1000;
  const Complex large{1 - 3 / (4 * y * y) + 105 / (16 * y * y * y * y), 1 / (2 * y) - 15 / (8 * y * y * y)};
  EXPECT_LT(relative_error(transition_function(y), large), 945.0 / 32 / std::pow(y, 5) + 1e-15);
}

TEST(SpecialFunctions, KnifeEdgeOfTheReference) {
  const auto rows = reference_rows("radio/fresnel_knife_edge.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/fresnel_knife_edge.csv";
  for (const auto& row : rows) {
    const Complex here = knife_edge(std::stod(row[1]));
    EXPECT_LT(std::abs(here - Complex{std::stod(row[4]), std::stod(row[5])}), bound) << row[1];
    EXPECT_NEAR(-20 * std::log10(std::abs(here)), std::stod(row[6]), 1e-12)
        << row[1];  // 8.7 dB times the relative error
  }
  EXPECT_GT(rows.size(), 40u);
}

TEST(SpecialFunctions, KnifeEdgeAgainstManyDigits) {
  for (const RayPoint& p : knife) EXPECT_LT(relative_error(knife_edge(p.t), {p.re, p.im}), bound) << p.t;
}

TEST(SpecialFunctions, KnifeEdgeTheorems) {
  EXPECT_LT(std::abs(knife_edge(0) - 0.5), 1e-16);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(knife_edge(infinity), Complex(0, 0));
  EXPECT_EQ(knife_edge(-infinity), Complex(1, 0));
  EXPECT_EQ(knife_edge(1e200), Complex(0, 0));
  for (double v = 0.01; v < 50; v *= 1.1)  // Babinet: an edge and its complement give the free field
    EXPECT_LT(std::abs(knife_edge(v) + knife_edge(-v) - 1.0), 1e-15);
  // ∫₀^∞ |E|² dv = 1/(2π): Simpson's rule to v = 20 with h = 0.001 (error h⁴/180·20·max|f⁗| < 1e-11), beyond it |E|² is
  // 1/(2π²v²) (1 − 3/(π²v⁴)+…), integral 1/(2π²·20) to 2e-9.
  const int steps = 20000;
  const double h = 20.0 / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i)
    sum += (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * std::norm(knife_edge(i * h));
  EXPECT_NEAR(sum * h / 3 + 1 / (2 * pi * pi * 20), 1 / (2 * pi), 5e-9);
}

}  // namespace
}  // namespace grimaldi
