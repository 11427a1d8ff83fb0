#include "propagation/edge_model.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

constexpr double edge_over_zone = 2;                ///< l/r_F from which UTD holds
constexpr double far_sheet = 0.1, far_solid = 0.5;  ///< N up to which the polygon form is taken
constexpr double leg_over_diameter = 2;             ///< s/D from which it does

/// 0 up to ½, 1 from 1 on.
double fade(double x) {
  if (x >= 1) return 1;
  if (!(x > 0.5)) return 0;
  const double s = std::sin(0.5 * pi * std::log2(2 * x));
  return s * s;
}

}  // namespace

double utd_share(DiffractionModel model, double length, const EdgePassage& passage, double wavelength) {
  if (model != DiffractionModel::automatic) return model == DiffractionModel::utd ? 1 : 0;
  const double zone = std::sqrt(wavelength * passage.s_in * passage.s_out / (passage.s_in + passage.s_out));
  return fade(length / std::max(edge_over_zone * zone, wavelength));
}

double polygon_share(double diameter, bool flat, double s_in, double s_out, double wavelength) {
  const double zone2 = wavelength * s_in * s_out / (s_in + s_out);
  const double far = 2 * std::sqrt((flat ? far_sheet : far_solid) * zone2) / diameter;
  return fade(std::min(far, std::min(s_in, s_out) / (leg_over_diameter * diameter)));
}

double clear_share(double diameter, double clearance) { return fade(clearance / diameter); }

bool shines_through(const SmallObjects& objects, std::uint32_t wedge, double s_in, double s_out, double wavelength) {
  const SmallObject* object = objects.at(wedge);
  if (object == nullptr || object->kind != ObjectKind::opening) return false;
  const double d = object->diameter;
  return polygon_share(d, true, s_in + d, s_out + d, wavelength) > 0;
}

double object_wave_bound(const SmallObjects& objects, const EdgePassage& first, double beyond, double s_out,
                         double wavenumber) {
  const SmallObject* object = objects.at(first.wedge);
  if (object == nullptr) return 0;
  const double d = object->diameter;
  // A share grows with the legs.
  if (polygon_share(d, object->flat(), first.s_in + beyond + d, s_out + beyond + d, 2 * pi / wavenumber) == 0) return 0;
  const double in = std::max(d, first.s_in - beyond - 0.5 * d), out = std::max(d, s_out - beyond - 0.5 * d);
  return 2 / (in + out) + wavenumber / pi * object->area / (in * out);
}

double largest_small_diameter(double reach, double wavelength) {
  // L is largest in the middle, reach/4.
  return 4 * std::sqrt(far_solid * wavelength * 0.25 * reach);
}

}  // namespace grimaldi
