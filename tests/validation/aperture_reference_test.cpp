// Apertures and knife edges against the reference files.

#include "core/vector.h"
#include "tests/validation/rows.h"
#include "validation/aperture_shape.h"
#include "validation/fraunhofer.h"
#include "validation/knife_edge.h"
#include "validation/rayleigh_sommerfeld.h"

namespace grimaldi {
namespace {

TEST(Fraunhofer, Reference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/aperture_fraunhofer.csv");
  Worst worst;
  for (const Row& row : rows) {
    const Aperture aperture = aperture_shape(row[1], row[2]);
    const auto value = fraunhofer_integral(aperture, number(row, 3), number(row, 4));
    worst.add(std::abs(value - complex_number(row, 5)) / area(aperture), 1e-12, row[0]);  // the file's tolerance
  }
  worst.expect_within_tolerance(90);
}

TEST(RayleighSommerfeld, Reference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/aperture_rayleigh_sommerfeld.csv");
  Worst worst;
  for (const Row& row : rows) {
    const Vec3 point{number(row, 3), number(row, 4), number(row, 5)};
    const auto value = rayleigh_sommerfeld(aperture_shape(row[1], row[2]), 2 * pi, point);
    worst.add(std::abs(value - complex_number(row, 6)), 1e-11, row[0]);  // the file's tolerance
  }
  worst.expect_within_tolerance(70);
}

TEST(Fraunhofer, AiryAndSlitReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/aperture_airy_facts.csv");
  Worst worst;
  for (const Row& row : rows) {
    const double x = number(row, 3), truth = number(row, 5);
    const double value = row[1] == "airy_dark_ring"    ? airy_encircled_energy(x)
                         : row[1] == "sinc2_side_lobe" ? slit_intensity(x)
                                                       : airy_intensity(x);
    worst.add(std::fabs(value - truth) / truth, 1e-12, row[0]);                             // the file's tolerance
    if (row[1] == "airy_dark_ring") worst.add(airy_intensity(x), 1e-30, row[0] + " dark");  // (2 · 1e-16/x)²
  }
  worst.expect_within_tolerance(10);
}

TEST(ExactKnifeEdge, FresnelIntegralReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/fresnel_knife_edge.csv");
  Worst field, loss;
  for (const Row& row : rows) {
    const auto value = exact_knife_edge(number(row, 1));
    field.add(std::abs(value - complex_number(row, 4)), 1e-13, row[0]);  // both as the file says
    loss.add(std::fabs(diffraction_loss(value) - number(row, 6)), 1e-9, row[0]);
  }
  field.expect_within_tolerance(40);
  loss.expect_within_tolerance(40);
}

TEST(ExactKnifeEdge, SingleEdgeReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/knife_edge_single.csv");
  Worst worst;
  for (const Row& row : rows) {
    const double wavelength = speed_of_light / (1e9 * number(row, 1)), d1 = number(row, 2), d2 = number(row, 3);
    const double v = number(row, 4) * std::sqrt(2 / wavelength * (1 / d1 + 1 / d2));
    worst.add(std::fabs(diffraction_loss(exact_knife_edge(v)) - number(row, 6)), 1e-6, row[0]);  // the file's tolerance
  }
  worst.expect_within_tolerance(20);
}

TEST(ExactKnifeEdge, SlitAndRectangleReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/fresnel_slit_rect.csv");
  // A slit is the difference of two edges, a rectangle the product of two slits.
  const auto slit = [](double wavelength, double width, double z, double x) {
    const double scale = std::sqrt(2 / (wavelength * z));
    return exact_knife_edge(scale * (-width / 2 - x)) - exact_knife_edge(scale * (width / 2 - x));
  };
  Worst worst;
  for (const Row& row : rows) {
    const double wavelength = number(row, 2), z = number(row, 5);
    auto value = slit(wavelength, number(row, 3), z, number(row, 6));
    if (row[1] == "rect") value *= slit(wavelength, number(row, 4), z, number(row, 7));
    worst.add(std::abs(value - complex_number(row, 8)), 1e-11, row[0]);  // the file's tolerance
  }
  worst.expect_within_tolerance(15);
}

TEST(DoubleKnifeEdge, Reference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/knife_edge_double.csv");
  Worst field, loss;
  for (const Row& row : rows) {
    const auto value = exact_double_knife_edge({speed_of_light / (1e9 * number(row, 1)), number(row, 2), number(row, 3),
                                                number(row, 4), number(row, 5), number(row, 6)});
    field.add(std::abs(value - complex_number(row, 7)), 1e-9, row[0]);  // both as the file says
    loss.add(std::fabs(diffraction_loss(value) - number(row, 9)), 1e-9, row[0]);
  }
  field.expect_within_tolerance(10);
  loss.expect_within_tolerance(10);
}

}  // namespace
}  // namespace grimaldi
