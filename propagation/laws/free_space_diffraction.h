#pragma once
// The free-space diffraction BSDF of a straight edge, in the form that holds in a city: one lobe per edge, Keller's
// form, no depth phase (Steinberg et al. 2024 with the repairs derived and measured for this project). exp(+jωt).
//
// A black edge takes an incident wave of amplitude E and gives E·U(v) into the direction rotated about the edge by ε
// from the wave's continuation; the wave of a conducting, dielectric or rigid wedge is that of three black edges: the
// incident wave and its images in the two faces. For the half-plane this is Sommerfeld's exact solution.

#include <complex>
#include <span>

namespace grimaldi {

/// Fresnel-Kirchhoff parameter of a straight edge.
/// Formula: v = 2 √(2L/λ) sin β |sin(ε/2)|, ε capped at ±π.
/// Inputs: effective distance L (m, ≥ 0; s s'/(s+s') for a point source), wavelength λ (m), sin_beta of the ray to the
/// edge (0 … 1), epsilon = rotation beyond the boundary (rad, > 0 in shadow).  Returns v ≥ 0.
double fresnel_parameter(double effective_distance, double wavelength, double sin_beta, double epsilon);

/// Field of one edge over the incident field continued: U = sgn(ε) ½ w(e^{3jπ/4} √(π/2) v), w = Faddeeva.
/// Source: Sommerfeld's half-plane, incident term; ITU-R P.526 knife edge is 1·[lit] + U e^{−jk(detour)}.
/// Inputs: v ≥ 0, shadow = true for ε ≥ 0.   Returns: dimensionless, |U| ≤ ½; tends to ±1/(2π v)·√2 e^{…} for large v.
/// Error: 1e-14 relative (that of faddeeva_on_ray).
std::complex<double> edge_wave(double v, bool shadow);

/// Edge waves of many directions at one wavelength, several at once: edge_wave(fresnel_parameter(L, λ, sin β, ε), ε ≥
/// 0). Inputs: spans of one length, as the functions above. Error: that of edge_wave, and 2 ulp of v.
void edge_waves(std::span<const double> effective_distance, double wavelength, std::span<const double> sin_beta,
                std::span<const double> epsilon, std::span<std::complex<double>> waves);

/// Weight of an end of the edge: UV = ∓½ w(e^{3jπ/4} √(π/2) v_V) e^{−jkδ}, v_V = 2√(δ/λ), − if the diffraction point
/// lies inside that end. Inputs: detour δ ≥ 0 (m) of the path over the end against the path over the diffraction point,
/// wavelength λ (m), wavenumber k (rad/m).
std::complex<double> edge_end_wave(double detour, double wavelength, double wavenumber, bool inside);

/// Share of an end's wave that a term of the edge's wave takes: its weight is T = H + Σ share UV, H = 1 for a
/// diffraction point on the edge, else 0. Formula: v²/(v² + v_V²), ½ for 0 and 0; v of the term's boundary, v_V of the
/// end (or any common multiple of both). Source: own. Behind the corner of a right-angled screen the wave of edge and
/// end is one product of two edge waves, U(v) U(v_V), which both edges of the corner have; the edge beyond exchanges v
/// and v_V, so that the shares add up to 1. All of it belongs to the edge whose diffraction point passes the corner
/// (v_V = 0), nothing to one whose term changes its sign (v = 0): neither makes a step, wherever the two happen.
/// Inputs: v, v_V ≥ 0.   Returns: 0 … 1.
double edge_end_share(double v, double v_end);

/// Power per unit length of edge and unit azimuth over the irradiance at the edge: dP/(ds dε) = I L sin²β |U(v)|², W/(m
/// rad) per W/m².
double edge_power_density(double effective_distance, double wavelength, double sin_beta, double epsilon);

/// Share of ∫|U|² beyond v: 2π ∫_v^∞ |U(u)|² du = 2 f(v) − π v (f² + g²), 1 at v = 0, with the auxiliary Fresnel
/// functions; the law from which azimuths are drawn. Source: tail of ∫|E|²dv, E the knife edge; ∫_0^∞ |E|² dv = 1/(2π).
/// Inputs: v ≥ 0. Error: 1e-10 for v ≤ 1e3.
double edge_tail(double v);

/// v at which edge_tail(v) = u, 0 < u ≤ 1: inverts the law above by bracketed Newton. Error: |edge_tail(v) − u| ≤
/// 1e-12.
double edge_tail_inverse(double u);

}  // namespace grimaldi
