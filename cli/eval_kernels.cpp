// The kernels of the engine as functions of `grimaldi eval`: never a second copy of them.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <complex>

#include "cli/eval_inputs.h"
#include "core/bands.h"
#include "core/constants.h"
#include "core/medium.h"
#include "core/p2040.h"
#include "core/radio_attenuation.h"
#include "core/special_functions.h"
#include "propagation/laws/aperture.h"
#include "propagation/laws/reflection.h"
#include "propagation/laws/utd.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Values = std::vector<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();

EvalInput with_stated(EvalInput input, double low, double high) {
  input.stated_low = low, input.stated_high = high;
  return input;
}

// ---- diffraction ----------------------------------------------------------------------------------------------------

EvalFunction transition() {
  return {"transition",
          "UTD transition function F(x)",
          {within("x", "argument", 0, infinite)},
          {"F_re", "F_im"},
          "F(x) = 2j sqrt(x) e^{jx} times the integral of e^{-jt^2} from sqrt(x) to infinity.",
          [](const EvalRow& row) { return flat({transition_function(row.number(0))}); }};
}

EvalFunction utd() {
  return {
      "utd",
      "Kouyoumjian-Pathak diffraction coefficients of a perfectly conducting wedge",
      {exterior_angle(), positive("lambda_m", "wavelength, m"), positive("L_m", "distance parameter, m"),
       within("beta0_deg", "angle of the incident ray against the edge", 0, 180),
       within("phi_deg", "direction of the diffracted ray, from face 0", 0, 360),
       within("phip_deg", "direction that the wave comes from, from face 0", 0, 360)},
      {"Ds_re", "Ds_im", "Dh_re", "Dh_im"},
      "sqrt(m); field = incident field at the edge times D A(s) e^{-jks}. Exactly on a boundary: the dark side.",
      [](const EvalRow& row) -> Values {
        const double exterior_deg = row.times(0, 180), n = row.number(0), sin_beta = std::sin(degree * row.number(3));
        if (!(sin_beta > 1e-9)) {
          row.fault(3, "the ray runs along the edge", "the coefficient grows as 1/sin(beta0)",
                    "give an angle between 0 and 180 degrees");
          return {};
        }
        const WedgeAngles angles = wedge_angles(row, exterior_deg, 4, 5, "degrees");
        if (!angles.good) return {};
        // Turns in degrees: boundaries at whole degrees are met exactly.
        const std::array<double, 4> turns = wedge_turns(exterior_deg, angles.phip, angles.phi, 180);
        const double length = row.number(2), phase_distance = 2 * pi / row.number(1) * length;
        WedgeTerms d;
        for (std::size_t i = 0; i < 4; ++i)
          d.term[i] = std::sqrt(length) / sin_beta * wedge_wave(n, phase_distance, degree * turns[i], turns[i] >= 0);
        return flat({d.soft(), d.hard()});
      }};
}

EvalFunction utd_total() {
  return {"utd-total",
          "plane wave on a wedge by UTD: geometrical optics and diffraction",
          {exterior_angle(), positive("k_rho", "distance from the edge times k, rad", 1e9),
           within("phi_deg", "direction of the point, from face 0", 0, 360),
           within("phip_deg", "direction that the wave comes from, from face 0", 0, 360)},
          {"soft_re", "soft_im", "hard_re", "hard_im"},
          "Incident wave e^{+j k rho cos(phi - phip)}. soft: u = 0 on the faces, hard: no flow through them.",
          [](const EvalRow& row) -> Values {
            const double exterior_deg = row.times(0, 180);
            const WedgeAngles angles = wedge_angles(row, exterior_deg, 2, 3, "degrees");
            if (!angles.good) return {};
            const WedgeTotal u = utd_plane_wave(exterior_deg, row.number(1), angles.phip, angles.phi, 180);
            return flat({u.soft, u.hard});
          }};
}

/// Numbers between blanks; a fault and nothing where one is no finite number.
Values numbers_of(const EvalRow& row, std::size_t input) {
  Values list;
  const std::string& text = row.text(input);
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at < end && (*at == ' ' || *at == '\t')) ++at;
    if (at == end) return list;
    double value = 0;
    const auto [rest, fault] = std::from_chars(at + (*at == '+'), end, value);
    if (fault != std::errc() || (rest != end && *rest != ' ' && *rest != '\t') || !std::isfinite(value)) {
      const std::string word(at, std::find(at, end, ' '));
      row.fault(input, fmt::format("\"{}\" is not a finite number", word), "a list of numbers between blanks is needed",
                "write e.g. 0.5 -1.25 3");
      return {};
    }
    list.push_back(value);
    at = rest;
  }
}

/// The polygon of a row of `fsd-field`; false with faults if it is none.
bool read_aperture(const EvalRow& row, TriangleAperture& aperture) {
  const Values places = numbers_of(row, 3), values = numbers_of(row, 4), corners = numbers_of(row, 5);
  if (places.empty() || values.empty() || corners.empty()) {
    if (!row.diagnostics().has_errors())
      row.fault(places.empty()   ? 3
                : values.empty() ? 4
                                 : 5,
                "an empty list", "a polygon of triangles is needed", "give numbers between blanks");
    return false;
  }
  if (places.size() % 2 != 0 || places.size() < 6)
    row.fault(3, fmt::format("{} numbers", places.size()), "x y of at least three vertices are needed",
              "give x and y of each vertex");
  if (values.size() != places.size())
    row.fault(4, fmt::format("{} numbers for {} vertices", values.size(), places.size() / 2),
              "a real and an imaginary part are needed for each vertex", "give as many numbers as in verts_xy");
  if (corners.size() % 3 != 0)
    row.fault(5, fmt::format("{} numbers", corners.size()), "a triangle has three corners",
              "give three vertex numbers for each triangle");
  for (const double corner : corners)
    if (corner != std::floor(corner) || corner < 0 || corner >= double(places.size() / 2)) {
      row.fault(5, fmt::format("{} is no vertex", corner),
                fmt::format("vertices go from 0 to {}", places.size() / 2 - 1), "count the vertices from 0");
      break;
    }
  if (row.diagnostics().has_errors()) return false;
  for (std::size_t i = 0; i < places.size(); i += 2) {
    aperture.vertices.push_back({places[i], places[i + 1]});
    aperture.amplitudes.emplace_back(values[i], values[i + 1]);
  }
  for (std::size_t i = 0; i < corners.size(); i += 3)
    aperture.triangles.push_back({std::size_t(corners[i]), std::size_t(corners[i + 1]), std::size_t(corners[i + 2])});
  return true;
}

EvalFunction fsd_field() {
  return {
      "fsd-field",
      "Fraunhofer field of triangles with linear amplitude (free-space diffraction BSDF), exact",
      {positive("k", "wavenumber"), within("xi_x", "direction cosine", -1e6, 1e6),
       within("xi_y", "direction cosine", -1e6, 1e6), word("verts_xy", "x y of each vertex, between blanks"),
       word("amps_re_im", "real and imaginary amplitude at each vertex"),
       word("tris", "three vertex numbers, from 0, for each triangle")},
      {"psi_re", "psi_im"},
      "psi = k/(2 pi R) times the integral of the amplitude times e^{-ik xi.q}, R = 1, exp(-i omega t) as published.",
      [](const EvalRow& row) -> Values {
        TriangleAperture aperture;
        if (!read_aperture(row, aperture)) return {};
        return flat({aperture_field(aperture, row.number(0), {row.number(1), row.number(2)})});
      }};
}

EvalFunction knife_edge_function() {
  return {"knife-edge",
          "field and loss behind a knife edge",
          {within("v", "Fresnel-Kirchhoff parameter, > 0 in shadow", -1e8, 1e8)},
          {"E_re", "E_im", "J_dB"},
          "E over the free field; J = -20 lg |E|.",
          [](const EvalRow& row) {
            const Complex field = knife_edge(row.number(0));
            return Values{field.real(), field.imag(), -20 * std::log10(std::abs(field))};
          }};
}

// ---- faces ----------------------------------------------------------------------------------------------------------

EvalInput material_name() { return word("material", "name in ITU-R P.2040, e.g. concrete"); }
EvalInput material_version() { return word("params", "version of the Recommendation: P.2040-1 ... P.2040-4"); }

/// Permittivity of the row's material (inputs 0 and 1) at input 2; nothing with a fault.
std::optional<Complex> permittivity_of(const EvalRow& row) {
  const std::optional<int> version = p2040_version(row.text(1));
  if (!version) {
    row.fault(1, fmt::format("\"{}\" is no version of P.2040", row.text(1)),
              "its tables differ from version to version", "write P.2040-1, P.2040-2, P.2040-3 or P.2040-4");
    return {};
  }
  const auto& table = p2040_materials(*version);
  const auto found = table.find(material_key(row.text(0)));
  if (found == table.end()) {
    std::vector<std::string> known;
    for (const auto& [name, material] : table) known.push_back(name);
    row.fault(0, fmt::format("unknown material \"{}\"", row.text(0)),
              fmt::format("not in the table of P.2040-{}", *version), did_you_mean(material_key(row.text(0)), known));
    return {};
  }
  return relative_permittivity(found->second, 1e9 * row.number(2), row.diagnostics());
}

/// cos θ of the angle of incidence, exactly 0 at 90 degrees.
double incidence_cosine(double theta_deg) { return theta_deg == 90 ? 0 : std::cos(degree * theta_deg); }

EvalFunction fresnel() {
  return {"fresnel",
          "reflection of a half-space",
          {material_name(), material_version(), positive("f_GHz", "frequency, GHz"),
           within("theta_deg", "angle of incidence from the normal", 0, 90)},
          {"RTE_re", "RTE_im", "RTM_re", "RTM_im"},
          "Perfect conductor: RTE = -1, RTM = +1. Case does not matter in names, a blank is an underscore.",
          [](const EvalRow& row) -> Values {
            const auto eta = permittivity_of(row);
            if (!eta) return {};
            const auto r = half_space_reflection(*eta, incidence_cosine(row.number(3)));
            return flat({r.te, r.tm});
          }};
}

EvalFunction slab() {
  return {
      "slab",
      "reflection and transmission of a slab in air",
      {material_name(), material_version(), positive("f_GHz", "frequency, GHz"),
       within("d_m", "thickness, m", 0, infinite), within("theta_deg", "angle of incidence from the normal", 0, 90)},
      {"RTE_re", "RTE_im", "RTM_re", "RTM_im", "TTE_re", "TTE_im", "TTM_re", "TTM_im"},
      "T at the exit face, straight opposite the entry, over the field without the slab at the entry.",
      [](const EvalRow& row) -> Values {
        const auto eta = permittivity_of(row);
        if (!eta) return {};
        const auto s = slab_coefficients(*eta, row.number(3), 2 * pi * 1e9 * row.number(2) / speed_of_light,
                                         incidence_cosine(row.number(4)));
        return flat({s.reflection.te, s.reflection.tm, s.transmission.te, s.transmission.tm});
      }};
}

// ---- air ------------------------------------------------------------------------------------------------------------

EvalFunction gas() {
  return {"gas",
          "specific attenuation of radio waves by gases, ITU-R P.676-13 line by line",
          {with_stated(positive("f_GHz", "frequency, GHz"), 1, 1000),
           within("P_hPa", "pressure of the dry air, hPa", 0, infinite), positive("T_K", "temperature, K"),
           within("rho_gm3", "water vapour, g/m3", 0, infinite)},
          {"gamma_dBkm"},
          "dB/km.",
          [](const EvalRow& row) {
            return Values{gas_attenuation(row.number(0), {row.number(1), row.number(2), row.number(3)}).total()};
          }};
}

EvalFunction rain() {
  return {
      "rain",
      "specific attenuation of radio waves by rain, ITU-R P.838-3",
      {with_stated(positive("f_GHz", "frequency, GHz"), 1, 1000), within("R_mmh", "rain rate, mm/h", 0, infinite),
       within("elev_deg", "elevation of the path", -90, 90),
       any_number("tau_deg", "tilt of the polarisation: 0 horizontal, 90 vertical, 45 circular")},
      {"gamma_dBkm"},
      "dB/km.",
      [](const EvalRow& row) {
        return Values{rain_attenuation(row.number(0), row.number(1), degree * row.number(2), degree * row.number(3))};
      }};
}

/// Exact mid-band frequency of a third-octave band by its nominal one; nothing if no band is called so.
std::optional<double> exact_frequency(double nominal) {
  const double exact = 1000 * std::pow(10.0, std::round(10 * std::log10(nominal / 1000)) / 10);
  // Nominal frequencies lie within 1.6 % of the exact ones (IEC 61260-1), bands 26 % apart.
  if (std::abs(nominal / exact - 1) > 0.016) return {};
  return exact;
}

EvalFunction air_absorption() {
  return {"air-absorption",
          "absorption of sound by the air, ISO 9613-1",
          {with_stated(within("temperature_C", "temperature, degrees Celsius", -200, 1000), -20, 50),
           with_stated(within("rel_humidity_pct", "relative humidity, %", 0, 100), 10, 100),
           with_stated(positive("nominal_frequency_Hz", "nominal frequency of a third-octave band, Hz"), 50, 10000)},
          {"alpha_dB_per_km"},
          "dB/km at 101.325 kPa, at the band's exact mid-band frequency 1000*10^(n/10) Hz.",
          [](const EvalRow& row) -> Values {
            const std::optional<double> frequency = exact_frequency(row.number(2));
            if (!frequency) {
              row.fault(
                  2, fmt::format("{} Hz is no nominal frequency", row.number(2)),
                  "third-octave bands are named 50, 63, 80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800 ...",
                  fmt::format("write {}",
                              nominal_frequency(
                                  1000 * std::pow(10.0, std::round(10 * std::log10(row.number(2) / 1000)) / 10))));
              return {};
            }
            const Air air{row.number(0) + 273.15, row.number(1) / 100, 101325};
            return {1000 * sound_attenuation(air, *frequency)};
          }};
}

}  // namespace

std::vector<EvalFunction> kernel_functions() {
  return {transition(), utd(),  utd_total(), fsd_field(), knife_edge_function(),
          fresnel(),    slab(), gas(),       rain(),      air_absorption()};
}

}  // namespace grimaldi
