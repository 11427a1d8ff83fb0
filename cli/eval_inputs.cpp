#include "cli/eval_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace grimaldi {

EvalInput any_number(const char* name, const char* meaning) { return {name, meaning}; }

EvalInput positive(const char* name, const char* meaning, double high) {
  return {name, meaning, EvalInput::Kind::number, 0, high, true};
}

EvalInput within(const char* name, const char* meaning, double low, double high) {
  return {name, meaning, EvalInput::Kind::number, low, high};
}

EvalInput word(const char* name, const char* meaning) { return {name, meaning, EvalInput::Kind::text}; }

EvalInput exterior_angle(double low) {
  return {"n", "exterior angle of the wedge over 180 degrees, e.g. 3/2", EvalInput::Kind::ratio, low, 2, low == 0};
}

WedgeAngles wedge_angles(const EvalRow& row, double exterior, std::size_t phi_input, std::size_t phip_input,
                         const char* unit) {
  WedgeAngles angles;
  for (const auto& [input, angle] : {std::pair{phi_input, &angles.phi}, std::pair{phip_input, &angles.phip}}) {
    *angle = row.number(input);
    if (*angle > exterior * (1 + 1e-12)) {
      row.fault(input, fmt::format("{} {} lie inside the wedge", *angle, unit),
                fmt::format("the air goes from 0 to {:.6g} {}", exterior, unit),
                "count the angle from face 0 through the air");
      angles.good = false;
    }
    *angle = std::min(*angle, exterior);
  }
  return angles;
}

std::vector<double> flat(std::initializer_list<std::complex<double>> list) {
  std::vector<double> values;
  for (const std::complex<double>& value : list) values.insert(values.end(), {value.real(), value.imag()});
  return values;
}

}  // namespace grimaldi
