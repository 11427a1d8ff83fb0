// The references as functions of `grimaldi eval`.

#include <cmath>
#include <complex>

#include "cli/eval_inputs.h"
#include "core/constants.h"
#include "validation/aperture_shape.h"
#include "validation/fraunhofer.h"
#include "validation/half_plane.h"
#include "validation/knife_edge.h"
#include "validation/rayleigh_sommerfeld.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Values = std::vector<double>;

constexpr double least_n = 0.05;  // of the references of wedges

EvalInput shape() { return word("shape", "rect, square, circle, annulus, regular_polygon, star_polygon, polygon ..."); }
EvalInput params() { return word("params", "sizes, e.g. wx=1;wy=2"); }

EvalFunction fraunhofer() {
  return {"fraunhofer",
          "Fourier amplitude of an aperture",
          {shape(), params(), within("kx", "rad per unit of length", -1e6, 1e6),
           within("ky", "rad per unit of length", -1e6, 1e6)},
          {"I_re", "I_im"},
          "I = integral over the aperture of e^{+j(kx x + ky y)}, unit of length squared.",
          [](const EvalRow& row) {
            return flat({fraunhofer_integral(aperture_shape(row.text(0), row.text(1)), row.number(2), row.number(3))});
          }};
}

EvalFunction rayleigh_sommerfeld_function() {
  return {"rayleigh-sommerfeld",
          "field behind an aperture, Rayleigh-Sommerfeld integral of the first kind",
          {shape(), params(), within("x", "wavelengths", -1e6, 1e6), within("y", "wavelengths", -1e6, 1e6),
           positive("z", "distance behind the aperture, wavelengths", 1e6)},
          {"u_re", "u_im"},
          "Unit plane wave e^{-jkz} at normal incidence; all lengths in wavelengths.",
          [](const EvalRow& row) {
            return flat({rayleigh_sommerfeld(aperture_shape(row.text(0), row.text(1)), 2 * pi,
                                             {row.number(2), row.number(3), row.number(4)})});
          }};
}

const std::vector<std::string> soft_hard = {"soft_re", "soft_im", "hard_re", "hard_im"};

Values flat(const WedgeField& u) { return grimaldi::flat({u.soft, u.hard}); }

EvalInput angle(const char* name, const char* meaning) { return within(name, meaning, 0, 360); }

EvalFunction wedge_exact() {
  return {"wedge-exact",
          "exact field of a plane wave on a wedge",
          {exterior_angle(least_n), within("k_rho", "distance from the edge times k, rad", 0, 1e6),
           angle("phi_deg", "direction of the point, from face 0"),
           angle("phip_deg", "direction that the wave comes from, from face 0")},
          soft_hard,
          "Incident wave e^{+j k rho cos(phi - phip)}. soft: u = 0 on the faces, hard: no flow through them.",
          [](const EvalRow& row) -> Values {
            const WedgeAngles a = wedge_angles(row, row.times(0, 180), 2, 3, "degrees");
            if (!a.good) return {};
            return flat(wedge_plane_wave(row.number(0), row.number(1), degree * a.phi, degree * a.phip));
          }};
}

EvalFunction wedge_exact_line() {
  return {
      "wedge-exact-line",
      "exact field of a line source beside a wedge",
      {exterior_angle(least_n), within("k_rho", "distance of the point from the edge times k, rad", 0, 1e6),
       within("k_rho_s", "distance of the source from the edge times k, rad", 0, 1e6),
       angle("phi_deg", "direction of the point, from face 0"),
       angle("phip_deg", "direction of the source, from face 0")},
      soft_hard,
      "Free field -(j/4) H0^(2)(kR).",
      [](const EvalRow& row) -> Values {
        const WedgeAngles a = wedge_angles(row, row.times(0, 180), 3, 4, "degrees");
        if (!a.good) return {};
        return flat(wedge_line_source(row.number(0), row.number(1), row.number(2), degree * a.phi, degree * a.phip));
      }};
}

EvalFunction wedge_exact_point() {
  return {"wedge-exact-point",
          "exact field of a point source beside a wedge",
          {exterior_angle(least_n), positive("k", "wavenumber, rad/m", 1e6),
           within("rho_s", "distance of the source from the edge, m", 0, 1e6),
           within("phi_s_rad", "direction of the source, from face 0", 0, 2 * pi * (1 + 1e-12)),
           within("z_s", "source along the edge, m", -1e6, 1e6),
           within("rho", "distance of the point from the edge, m", 0, 1e6),
           within("phi_rad", "direction of the point, from face 0", 0, 2 * pi * (1 + 1e-12)),
           within("z", "point along the edge, m", -1e6, 1e6)},
          soft_hard,
          "Free field e^{-jkR}/R. Angles in radians.",
          [](const EvalRow& row) -> Values {
            const WedgeAngles a = wedge_angles(row, row.times(0, pi), 6, 3, "rad");
            if (!a.good) return {};
            return flat(wedge_point_source(row.number(0), row.number(1), {row.number(2), a.phip, row.number(4)},
                                           {row.number(5), a.phi, row.number(7)}));
          }};
}

EvalFunction half_plane_exact() {
  return {
      "half-plane-exact",
      "Sommerfeld's half-plane under a plane wave",
      {within("k_rho", "distance from the edge times k, rad", 0, 1e9),
       angle("phi_deg", "direction of the point, from the half-plane"),
       angle("phip_deg", "direction that the wave comes from")},
      soft_hard,
      "Incident wave e^{+j k rho cos(phi - phip)}.",
      [](const EvalRow& row) { return flat(half_plane_plane_wave(row.number(0), row.number(1), row.number(2), 180)); }};
}

EvalFunction double_knife_edge() {
  return {"double-knife-edge",
          "field behind two knife edges, paraxial",
          {positive("f_GHz", "frequency, GHz"), positive("d1_m", "transmitter to edge 1, m"),
           positive("d2_m", "edge 1 to edge 2, m"), positive("d3_m", "edge 2 to receiver, m"),
           any_number("h1_m", "height of edge 1 above the straight line, m; Fresnel parameter up to 100"),
           any_number("h2_m", "height of edge 2 above the straight line, m; likewise")},
          {"E_re", "E_im", "loss_exact_dB"},
          "E over the free field; loss = -20 lg |E|.",
          [](const EvalRow& row) {
            const std::complex<double> field =
                exact_double_knife_edge({speed_of_light / (1e9 * row.number(0)), row.number(1), row.number(2),
                                         row.number(3), row.number(4), row.number(5)});
            return Values{field.real(), field.imag(), diffraction_loss(field)};
          }};
}

}  // namespace

std::vector<EvalFunction> reference_functions() {
  return {fraunhofer(),        rayleigh_sommerfeld_function(),
          wedge_exact(),       wedge_exact_line(),
          wedge_exact_point(), half_plane_exact(),
          double_knife_edge()};
}

}  // namespace grimaldi
