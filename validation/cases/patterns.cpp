#include "validation/cases/patterns.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

const char* name_of(Theory theory) {
  switch (theory) {
    case Theory::truth:
      return "Rayleigh-Sommerfeld";
    case Theory::fraunhofer:
      return "Fraunhofer";
    case Theory::polygon:
      return "BSDF, whole polygon";
    case Theory::printed:
      return "BSDF as printed";
    case Theory::edges:
      return "UTD, edges with ends";
    case Theory::cones:
      return "UTD, cones alone";
  }
  return "";
}

}  // namespace

std::complex<double> field_of(Theory theory, const Opening& opening, const Vec3& point) {
  switch (theory) {
    case Theory::truth:
      return true_field(opening, point);
    case Theory::fraunhofer:
      return fraunhofer_field(opening, point);
    case Theory::polygon:
      return polygon_field(opening, point);
    case Theory::printed:
      return printed_field(opening, point);
    case Theory::edges:
      return connected_field(opening, point);
    case Theory::cones:
      return connected_field(opening, point, EdgeEnds::none);
  }
  return 0;
}

double level_of(const std::complex<double>& field) { return std::max(20 * std::log10(std::abs(field)), -300.0); }

double median_error(Theory theory, const Opening& opening, double fresnel_number) {
  std::vector<double> truth, ours;
  for (const Vec3& point : observation_points(opening, distance_of(opening.size, fresnel_number), 1024)) {
    truth.push_back(std::norm(true_field(opening, point)));
    ours.push_back(std::norm(field_of(theory, opening, point)));
  }
  return pattern_error(ours, truth).median;
}

Figure pattern_figure(const Opening& opening, double fresnel_number, double reach, const std::vector<Theory>& theories,
                      const PatternWords& words) {
  const double z = distance_of(opening.size, fresnel_number), half = reach * (opening.size / 2 + z / opening.size);
  constexpr int side = 112;
  RasterRow row;
  row.title = words.title;
  row.x_name = "x/λ", row.y_name = "y/λ", row.scale_name = "intensity, dB";
  row.left = row.bottom = -half, row.right = row.top = half;
  row.low = -40, row.high = 0;
  double peak = 0;
  for (const Theory theory : theories) {
    Raster raster{name_of(theory), side, {}};
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const Vec3 point{half * ((2 * i + 1.0) / side - 1), half * ((2 * j + 1.0) / side - 1), z};
        raster.values.push_back(level_of(field_of(theory, opening, point)));
      }
    if (row.panels.empty()) peak = *std::max_element(raster.values.begin(), raster.values.end());
    for (double& value : raster.values) value -= peak;
    row.panels.push_back(std::move(raster));
  }
  return {words.file, words.caption, std::move(row)};
}

Figure cut_figure(const Opening& opening, double fresnel_number, double reach, const std::vector<Theory>& theories,
                  const PatternWords& words) {
  const double z = distance_of(opening.size, fresnel_number);
  const double half = std::min(reach * (opening.size / 2 + z / opening.size), 1.7 * z);
  LineChart chart;
  chart.title = words.title;
  chart.x_name = "x/λ", chart.y_name = "intensity, dB";
  chart.low = -45, chart.high = 10;
  double peak = 0;
  for (const Theory theory : theories) {
    Curve curve{name_of(theory), {}, {}};
    for (int i = 0; i <= 800; ++i) {
      const double x = half * (i / 400.0 - 1);
      curve.x.push_back(x);
      // A little off y = 0, where corners may lie.
      curve.y.push_back(level_of(field_of(theory, opening, {x, 1e-3, z})));
    }
    if (chart.curves.empty()) peak = *std::max_element(curve.y.begin(), curve.y.end());
    for (double& value : curve.y) value -= peak;
    chart.curves.push_back(std::move(curve));
  }
  return {words.file, words.caption, std::move(chart)};
}

}  // namespace grimaldi
