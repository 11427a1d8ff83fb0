#pragma once
// Reference: Rayleigh-Sommerfeld field behind an aperture, near field to far field. exp(+jωt).

#include <complex>
#include <functional>

#include "core/vector.h"
#include "validation/aperture.h"

namespace grimaldi {

/// first: the field is given in the opening (0 elsewhere); second: its normal derivative is.
enum class RayleighSommerfeld { first, second };

/// Field of a unit plane wave e^{−jkz} at normal incidence on the aperture in z = 0 of an opaque screen.
/// Formula: first u = (1/2π) ∫ (z/R)(jk + 1/R) e^{−jkR}/R dA; second u = (jk/2π) ∫ e^{−jkR}/R dA. Reduced to the rim:
/// u = −(z/2π) ∮ (e^{−jkR}/R − e^{−jkz}/z) dθ, u = −(1/2π) ∮ (e^{−jkR} − e^{−jkz}) dθ, θ about the foot of the point.
/// The differences vanish at the foot, so that a point above the rim needs no case of its own. Far beside the opening
/// the terms of z cancel over the rim and are left out, and the phase is counted from the origin.
/// Source: Goodman, Introduction to Fourier Optics, 3.5; Dubra & Ferrari, Am. J. Phys. 67 (1999) 87 for the rim.
/// Inputs: wavenumber k > 0 (rad per unit of length), point with z > 0 (unit of length; z ≥ 1e-4 of a disc's radius).
/// Returns: dimensionless, over the incident field's amplitude.
/// Error: 1e-13 absolute while k·(path) ≤ 1e3, then 1e-16·k·(path); in the far field 1e-16·(distance/size) of |u|
/// besides that common phase (held by RayleighSommerfeld.*).
/// Throws: InputErrors if z ≤ 0, k ≤ 0 or a number is not finite; std::runtime_error if a point lies too close to the
/// rim of a disc (z < 1e-4 of its radius).
std::complex<double> rayleigh_sommerfeld(const Aperture& aperture, double k, const Vec3& point,
                                         RayleighSommerfeld kind = RayleighSommerfeld::first);

/// On the axis of a disc, closed form: first e^{−jkz} − (z/R) e^{−jkR}, second e^{−jkz} − e^{−jkR}, R = √(z² + a²).
/// Error: 1e-16·k·R.
std::complex<double> rayleigh_sommerfeld_on_axis(double radius, double k, double z,
                                                 RayleighSommerfeld kind = RayleighSommerfeld::first);

/// The same integrals, taken over the opening in two dimensions, for any incident wave: the second reference.
/// Formula: first with u(x, y, 0) = incident, second with −∂u/∂z = jk·incident (so give incident times the cosine of
/// its own incidence). Gauss-Legendre products on triangles and rings, refined until two refinements agree.
/// Inputs: incident(x, y) smooth on the convex hull of the opening and the origin, e.g. that of a point source on the
/// axis, e^{−jkS}/S, S = √(x² + y² + h²).
/// Valid: z ≥ 0.1 wavelengths and k·size ≤ 500; slow (1e4 to 1e7 evaluations).
/// Error: 1e-12 of max|incident|, from 5e-14 of the integral of the modulus (held by RayleighSommerfeld.*).
/// Throws: std::runtime_error if the refinements do not agree; InputErrors as above.
std::complex<double> rayleigh_sommerfeld_direct(const Aperture& aperture, double k, const Vec3& point,
                                                const std::function<std::complex<double>(double x, double y)>& incident,
                                                RayleighSommerfeld kind = RayleighSommerfeld::first);

}  // namespace grimaldi
