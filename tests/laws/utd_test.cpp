// The wedge coefficients against many digits, against the reference files, and against what must hold for any wedge.

#include "propagation/laws/utd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/special_functions.h"
#include "propagation/laws/free_space_diffraction.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();

// "3/2" or "1.5".
double ratio(const std::string& text) {
  const auto slash = text.find('/');
  return slash == std::string::npos ? std::stod(text) : std::stod(text) / std::stod(text.substr(slash + 1));
}

struct Point {
  double n, phase_distance, turn, re, im;
};
// mpmath 1.3, 50 digits, on the exact values of the doubles: sgn(ε) cos(ε/2n) sin(|ε|/2)/sin(|ε|/2n) e^{jt²}
// erfc(e^{jπ/4} t)/(2n), t = √(2kL) sin(|ε|/2).
constexpr Point points[] = {
    {2.0, 0.0008569469406378371, 6.28318e-300, 0.5, -5.1886160633204387948e-302},
    {2.0, 82.66639302287867, 6.2831799999999995e-12, 0.49999999998388467517, -1.6115324826634349175e-11},
    {2.0, 10549.327498221188, 6.28318e-05, 0.49817954066166738282, -0.0018100979003916978466},
    {2.0, 0.7029400289471459, 1.8849539999999998, 0.17055332410066455972, -0.091908925737985731487},
    {2.0, 53.51519296922942, -0.1256636, -0.28030889292115251428, 0.11352156440758507001},
    {2.0, 598293.2888597196, 4.398225999999999, 0.000046456358685686068534, -0.000046456299367986435497},
    {2.0, 3.6382639113261783, -5.5920302, -0.0065946651668768324062, 0.0034370145506863194707},
    {2.0, 526.861086943407, 5.969021, 0.00024620566835614530443, -0.00023688015456555774247},
    {1.5, 0.0008890310214920114, 4.7123850000000004e-300, 0.5, -3.963640803382898792e-302},
    {1.5, 19934.67253265694, 4.712385000000001e-05, 0.498123130721056143, -0.0018658574414380496716},
    {1.5, 65.2745489811109, -0.09424769999999999, -0.31007901286680867703, 0.10811148339287551122},
    {1.5, 10.2102154757137, -4.19402265, -0.0052856736546616722033, 0.0049543958787685220103},
    {1.6666666666666667, 0.0014522909874277827, 5.235983333333334e-300, 0.5, -5.6288560791518997106e-302},
    {1.6666666666666667, 12847.71815574952, 5.235983333333333e-05, 0.49832582338935904845, -0.0016654100756696454073},
    {1.6666666666666667, 56.06476032562327, -0.10471966666666666, -0.30558285457684212498, 0.10909786237527877355},
    {1.6666666666666667, 11.461417586011581, -4.660025166666666, -0.0045180927613868317761, 0.0041648686715561925662},
    {1.3333333333333333, 0.0009519014892735685, 4.1887866666666664e-300, 0.5, -3.645686445792559809e-302},
    {1.3333333333333333, 17982.908554684185, 4.188786666666666e-05, 0.49841543978006278121, -0.0015767052387659121711},
    {1.3333333333333333, 58.71037496287182, -0.08377573333333332, -0.33497333452817063387, 0.10142569422588774717},
    {1.3333333333333333, 10.998359577917627, -3.7280201333333327, -0.005693902796893293296, 0.0054202014974796161047},
    {1.75, 0.001092445106001116, 5.4977825e-300, 0.5, -5.1260452342897569538e-302},
    {1.75, 11669.31584076141, 5.4977825e-05, 0.49832467040395527891, -0.0016665510031644853381},
    {1.75, 67.64075964686273, -0.10995565, -0.28299699867973216063, 0.113166052277397335},
    {1.75, 4.927673032107023, -4.893026425, -0.0067979583666134410187, 0.0054493005900510988526},
    {1.1, 0.0019482202083473043, 3.4557490000000004e-300, 0.5, -4.302850736729194455e-302},
    {1.1, 14399.72436300206, 3.455749e-05, 0.49883019926383470675, -0.0011655149525746415793},
    {1.1, 46.90415849766152, -0.06911498, -0.37356770550201970705, 0.087087221474913488783},
    {1.1, 7.18456013208689, -3.07561661, -0.0086057759855002032179, 0.0080339860423428556427},
    {1.0, 0.0013763776894552984, 3.14159e-300, 0.5, -3.2878605251276887058e-302},
    {1.0, 15229.7320495245, 3.14159e-05, 0.49890632430921317575, -0.0010899287950678198774},
    {1.0, 66.38715160493898, -0.0628318, -0.36438894391165321955, 0.090960603220024895158},
    {1.0, 10.548372192706442, -2.7960151, -0.0077497118290357871774, 0.0073826920036387965823},
    {0.6, 0.0017909562996744025, 1.884954e-300, 0.5, -2.2502891112324404793e-302},
    {0.6, 18570.43976768355, 1.884954e-05, 0.49927538721249043992, -0.00072296638042386781436},
    {0.6, 58.43098972572032, -0.037699079999999996, -0.42040553398773395888, 0.062722397728334626464},
    {0.6, 12.231883267870218, -1.67760906, -0.012110134287696076342, 0.011259917731310833476},
    {0.25, 0.0009274361929793078, 7.853975e-301, 0.5, -6.7472469020574505006e-303},
    {0.25, 17809.137326340202, 7.853975e-06, 0.49970433090823499226, -0.00029539462700298895037},
    {0.25, 23.53930959552284, -0.01570795, -0.47837875745766768201, 0.020081209460021432282},
    {0.25, 7.809849187132043, -0.699003775, -0.037999242710557963392, 0.025349192274498946821},
    {0.013, 0.0009408368702285933, 4.084067e-302, 0.5, -3.5338254198060144954e-304},
    {0.013, 18091.50536942302, 4.084067e-07, 0.49998450375653719168, -0.000015495447969394964444},
    {0.013, 52.89091509207493, -0.0008168133999999999, -0.49816030616075735662, 0.001666396231283302004},
    {0.013, 11.04362501320942, -0.0363481963, -0.11371401363115049037, 0.007463562136630955284},
};

// 1e-14 of the term, as the header says; near |ε| = nπ the cosine is small and 1e-15 counts.
TEST(Utd, TermAgainstManyDigits) {
  double worst = 0;
  for (const Point& p : points) {
    const Complex truth{p.re, p.im}, here = wedge_wave(p.n, p.phase_distance, p.turn, p.turn > 0);
    EXPECT_LT(std::abs(here - truth), 1e-14 * std::abs(truth) + 1e-15 * (std::abs(p.turn) > 0.9 * p.n * pi))
        << p.n << " " << p.phase_distance << " " << p.turn;
    if (std::abs(p.turn) < 0.9 * p.n * pi) worst = std::max(worst, std::abs(here - truth) / std::abs(truth));
  }
  std::printf("wedge term: largest relative error %.1e\n", worst);
}

TEST(Utd, TermIsOneHalfAtItsBoundary) {
  for (const double n : {0.3, 1.0, 1.5, 2.0}) {
    // w(0) is 1 to an ulp of the table.
    EXPECT_LT(std::abs(wedge_wave(n, 50, 0, true) - 0.5), 1e-16);
    EXPECT_LT(std::abs(wedge_wave(n, 50, 0, false) + 0.5), 1e-16);
    // Continuous from either side: the argument of w is √(kL/2) ε, and |w'(0)| = 2/√π.
    for (const double turn : {1e-300, 1e-16, 1e-9})
      EXPECT_LT(std::abs(wedge_wave(n, 50, turn, true) - 0.5), 6 * turn + 1e-16);
  }
}

// The form as printed, cot times the transition function, away from the pole where both keep their digits.
TEST(Utd, TermIsCotangentTimesTransitionFunction) {
  for (const double n : {0.7, 1.5, 2.0})
    for (const double turn : {-2.0, -0.5, 0.1, 1.0, 2.0})
      for (const double kl : {0.1, 5.0, 1e3}) {
        const double sine = std::sin(0.5 * turn);
        const Complex printed = -std::polar(1.0, -pi / 4) / (2 * n * std::sqrt(2 * pi * kl)) /
                                std::tan(-0.5 * turn / n) * transition_function(2 * kl * sine * sine);
        const Complex here = wedge_wave(n, kl, turn, turn > 0);
        EXPECT_LT(std::abs(here - printed), 1e-14 * std::abs(printed)) << n << " " << turn << " " << kl;
      }
}

// 1e-10 of max(|Ds|, |Dh|) is asked; the angles lie 2 ulp off, which √(kL/2) magnifies: 1e-13.
TEST(Utd, CoefficientsOfTheReference) {
  const auto rows = reference_rows("radio/utd_kp_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/utd_kp_coefficients.csv";
  double worst = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const double k = 2 * pi / number(2), length = number(3), degree = pi / 180;
    const WedgeTerms d = utd_coefficients(ratio(row[1]) * pi, number(6) * degree, number(5) * degree,
                                          std::sin(number(4) * degree), k, {length, length, length, length});
    const Complex soft{number(7), number(8)}, hard{number(9), number(10)};
    const double scale = std::max(std::abs(soft), std::abs(hard));
    double error = std::max(std::abs(d.soft() - soft), std::abs(d.hard() - hard)) / scale;
    for (std::size_t i = 0; i < 4; ++i)
      error = std::max(error, std::abs(d.term[i] - Complex{number(11 + 2 * i), number(12 + 2 * i)}) / scale);
    EXPECT_LT(error, 1e-13) << row[0];
    worst = std::max(worst, error);
  }
  std::printf("utd coefficients: %zu rows, largest error %.1e\n", rows.size(), worst);
  EXPECT_GT(rows.size(), 90u);
}

TEST(Utd, TotalFieldOfTheReference) {
  const auto rows = reference_rows("radio/utd_vs_exact.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/utd_vs_exact.csv";
  double worst = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const double n = ratio(row[1]);
    const WedgeTotal u = utd_plane_wave(n * 180, number(2), number(4), number(3), 180);
    const double error =
        std::max(std::abs(u.soft - Complex{number(5), number(6)}), std::abs(u.hard - Complex{number(7), number(8)}));
    EXPECT_LT(error, 1e-14 * (1 + number(2))) << row[0];
    worst = std::max(worst, error);
  }
  std::printf("utd total field: %zu rows, largest error %.1e\n", rows.size(), worst);
  EXPECT_GT(rows.size(), 60u);
}

// n = 2 is Sommerfeld's half-plane; 1e-12 and 1e-10 at kρ = 1e4 are the file's own bounds.
TEST(Utd, HalfPlaneIsSommerfelds) {
  const auto rows = reference_rows("radio/halfplane_sommerfeld.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/halfplane_sommerfeld.csv";
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    for (const BoundarySide side : {BoundarySide::lit, BoundarySide::dark}) {
      const WedgeTotal u = utd_plane_wave(360, number(1), number(3), number(2), 180, side);
      const double bound = number(1) > 1000 ? 1e-10 : 1e-12;
      EXPECT_LT(std::abs(u.soft - Complex{number(4), number(5)}), bound) << row[0];
      EXPECT_LT(std::abs(u.hard - Complex{number(6), number(7)}), bound) << row[0];
    }
  }
}

// Without a file: v(ψ) = e^{jkρ cos ψ} (1 − ½ erfc(…)) by the knife edge's own function, E(v) of v = −2√(kρ/π)
// cos(ψ/2), against terms and images.
TEST(Utd, HalfPlaneFromTheKnifeEdge) {
  for (const double k_rho : {0.1, 3.0, 80.0})
    for (const double phi_in : {0.2, 1.5, 3.0})
      for (double phi = 0; phi <= 2 * pi; phi += 0.1) {
        const auto family = [&](double psi) {
          return std::polar(1.0, k_rho * std::cos(psi)) * knife_edge(-2 * std::sqrt(k_rho / pi) * std::cos(0.5 * psi));
        };
        const Complex i = family(phi - phi_in), r = family(phi + phi_in);
        const WedgeTotal u = utd_plane_wave(2 * pi, k_rho, phi_in, phi);
        EXPECT_LT(std::abs(u.soft - (i - r)), 1e-13 * (1 + k_rho));
        EXPECT_LT(std::abs(u.hard - (i + r)), 1e-13 * (1 + k_rho));
      }
}

// An inner corner of nπ = π/m is served by images alone: the terms cancel in pairs.
TEST(Utd, InnerCornersOfWholePartsNeedNoDiffraction) {
  for (const int m : {1, 2, 3, 5})
    for (const double phi : {0.05, 0.3, 0.49}) {
      const double angle = pi / m, at = phi * angle, in = 0.37 * angle, k_rho = 12;
      Complex soft = 0, hard = 0;
      for (int image = 0; image < m; ++image)
        for (const double sign : {1.0, -1.0}) {
          const Complex wave = std::polar(1.0, k_rho * std::cos(at - sign * in - 2 * image * angle));
          soft += sign * wave, hard += wave;
        }
      const WedgeTotal u = utd_plane_wave(angle, k_rho, in, at);
      EXPECT_LT(std::abs(u.soft - soft), 2e-14 * k_rho) << m << " " << phi;
      EXPECT_LT(std::abs(u.hard - hard), 2e-14 * k_rho) << m << " " << phi;
    }
}

// Over each boundary, geometrical optics and diffraction together are continuous: a step of 2e-9 rad moves the field by
// its slope, at most 3 kρ + 3√(kρ) times as much. On the boundary itself both sides give the same.
TEST(Utd, TotalFieldIsContinuousOverBoundaries) {
  for (const double n : {0.8, 1.1, 1.5, 5.0 / 3, 2.0})
    for (const double k_rho : {0.3, 20.0, 1000.0})
      for (const double phi_in : {11.0, 30.0, 100.0, 139.0}) {
        if (phi_in > 180 * n) continue;
        for (const double boundary : {phi_in + 180, phi_in - 180, 180 - phi_in, 360 * n - 180 - phi_in}) {
          const double step = 1e-9 * 180 / pi;
          if (boundary < step || boundary > 180 * n - step) continue;
          const auto at = [&](double phi, BoundarySide side) {
            return utd_plane_wave(180 * n, k_rho, phi_in, phi, 180, side);
          };
          const WedgeTotal before = at(boundary - step, BoundarySide::dark),
                           behind = at(boundary + step, BoundarySide::dark), lit = at(boundary, BoundarySide::lit),
                           dark = at(boundary, BoundarySide::dark);
          const double slope = 2e-9 * (6 * k_rho + 6 * std::sqrt(k_rho) + 3);
          EXPECT_LT(std::abs(before.soft - behind.soft), slope) << n << " " << k_rho << " " << phi_in;
          EXPECT_LT(std::abs(before.hard - behind.hard), slope);
          EXPECT_LT(std::abs(lit.soft - dark.soft), 1e-13 * (1 + k_rho));
          EXPECT_LT(std::abs(lit.hard - dark.hard), 1e-13 * (1 + k_rho));
        }
      }
}

// The soft field vanishes on the faces (to rounding), whatever the wedge.
TEST(Utd, SoftFieldVanishesOnTheFaces) {
  for (const double n : {0.7, 1.2, 1.5, 2.0})
    for (const double k_rho : {0.5, 30.0})
      for (const double phi : {0.0, 180 * n})
        EXPECT_LT(std::abs(utd_plane_wave(180 * n, k_rho, 0.3 * 180 * n, phi, 180).soft), 1e-13 * (1 + k_rho))
            << n << " " << phi;
}

// Swapping the ends leaves soft, hard and any faces' coefficient as they were; swapping the faces too.
TEST(Utd, Reciprocity) {
  const WedgeFace concrete{{5.24, -0.6}, 0.2}, glass{{6.31, -0.1}, infinite};
  for (int i = 0; i < 200; ++i) {
    const auto u = uniform4(5, 1, static_cast<std::uint64_t>(i), 0);
    const double angle = (1 + u[0]) * pi, a = u[1] * angle, b = u[2] * angle, sin_beta = 0.2 + 0.8 * u[3], k = 40;
    const std::array<double, 4> length = {3, 3, 3, 3};
    const auto with_faces = [&](const WedgeFace& face_0, const WedgeFace& face_n, double in, double out, bool hard) {
      const FaceReflections r = reciprocal_face_reflections(face_0, face_n, angle, in, out, sin_beta, k);
      const WedgeTerms d = utd_coefficients(angle, in, out, sin_beta, k, length);
      return hard ? d.with_faces(r.face_0.tm, r.face_n.tm) : d.with_faces(r.face_0.te, r.face_n.te);
    };
    const WedgeTerms there = utd_coefficients(angle, a, b, sin_beta, k, length),
                     back = utd_coefficients(angle, b, a, sin_beta, k, length);
    // Terms are at most √L/(2 sin β); angles round by 1e-15, magnified by √(kL/2) < 8.
    const double bound = 1e-13 * std::sqrt(3.0) / sin_beta;
    EXPECT_LT(std::abs(there.soft() - back.soft()), bound);
    EXPECT_LT(std::abs(there.hard() - back.hard()), bound);
    for (const bool hard : {false, true}) {
      const Complex here = with_faces(concrete, glass, a, b, hard);
      EXPECT_LT(std::abs(here - with_faces(concrete, glass, b, a, hard)), bound);
      EXPECT_LT(std::abs(here - with_faces(glass, concrete, angle - a, angle - b, hard)), bound);
    }
  }
}

// Faces of a perfect conductor are the soft and the hard wedge; at a face's reflection boundary its coefficient is that
// of the face, so reflected and diffracted wave close: r + (r·(−½) on the lit side) = r·½ on the dark one.
TEST(Utd, FacesOfFiniteConductivity) {
  const WedgeTerms d = utd_coefficients(1.5 * pi, 0.7, 2.9, 0.9, 50, {2, 3, 4, 5});
  EXPECT_LT(std::abs(d.with_faces(-1, -1) - d.soft()), 1e-15);
  EXPECT_LT(std::abs(d.with_faces(1, 1) - d.hard()), 1e-15);
  const WedgeFace concrete{{5.24, -0.6}, infinite}, glass{{6.31, -0.1}, infinite};
  const double in = 0.8, beta = 0.6;
  const auto at_0 = reciprocal_face_reflections(concrete, glass, 1.5 * pi, in, pi - in, beta, 50);
  const auto r_0 = half_space_reflection(concrete.permittivity, beta * std::sin(in));
  EXPECT_LT(std::abs(at_0.face_0.te - r_0.te) + std::abs(at_0.face_0.tm - r_0.tm), 1e-14);
  const double near_n = 1.5 * pi - 0.8;
  const auto at_n = reciprocal_face_reflections(concrete, glass, 1.5 * pi, near_n, 3 * pi - pi - near_n, beta, 50);
  const auto r_n = half_space_reflection(glass.permittivity, beta * std::sin(0.8));
  EXPECT_LT(std::abs(at_n.face_n.te - r_n.te) + std::abs(at_n.face_n.tm - r_n.tm), 1e-14);
}

// Close to a boundary each term is the edge wave of free_space_diffraction at that turn; exactly so for n = 2 in pairs.
TEST(Utd, TermsOfAHalfPlaneAreEdgeWaves) {
  for (const double turn : {-2.0, -0.3, 0.01, 1.0, 3.0}) {
    const double kl = 37;
    // The pair of a family has turns ε and −(2π − …): ε₂ = −2π − ε for n = 2.
    const Complex pair = wedge_wave(2, kl, turn, turn > 0) + wedge_wave(2, kl, -2 * pi - turn, false);
    const double v = 2 * std::sqrt(kl / pi) * std::abs(std::sin(0.5 * turn));
    EXPECT_LT(std::abs(pair - edge_wave(v, turn > 0)), 1e-14) << turn;
  }
}

TEST(Utd, ManyAtOnceGiveTheSameBits) {
  constexpr std::size_t count = 1003;
  std::vector<double> in(count), out(count), sine(count), length(count), turn(count), phase(count);
  const double angle = 1.5 * pi, k = 70;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = uniform4(6, 1, i, 0);
    in[i] = u[0] * angle, out[i] = u[1] * angle, sine[i] = 0.1 + 0.9 * u[2], length[i] = 1e4 * u[3] * u[3] * u[3];
    turn[i] = i % 17 == 0 ? 0 : (2 * u[0] - 1) * angle, phase[i] = k * length[i];
  }
  std::vector<WedgeTerms> many(count);
  utd_coefficients(angle, in, out, sine, k, length, many);
  std::vector<Complex> waves(count);
  wedge_waves(1.5, phase, turn, waves, BoundarySide::lit);
  for (std::size_t i = 0; i < count; ++i) {
    const double l = length[i];
    EXPECT_EQ(many[i].term, utd_coefficients(angle, in[i], out[i], sine[i], k, {l, l, l, l}).term);
    EXPECT_EQ(waves[i], wedge_wave(1.5, phase[i], turn[i], turn[i] > 0));
  }
}

TEST(Utd, SharesOfTheWaysThereAndBack) {
  EXPECT_EQ(face_share(0.3, 0.3), 0.5);
  EXPECT_EQ(face_share(0, 0), 0.5);
  EXPECT_EQ(face_share(0.7, 0), 0);  // out along the face: the coefficient of that way alone
  EXPECT_NEAR(face_share(0.2, 0.9) + face_share(0.9, 0.2), 1, 1e-15);
}

}  // namespace
}  // namespace grimaldi
