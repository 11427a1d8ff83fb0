#pragma once
// Reference: the Fraunhofer integral of an aperture, and the patterns of optics that follow from it.

#include <complex>
#include <functional>

#include "validation/aperture.h"

namespace grimaldi {

/// Fourier amplitude of an aperture under constant unit amplitude.
/// Formula: I(kx, ky) = ∫ e^{+j(kx x + ky y)} dx dy. Polygon: a fan of triangles, each 2|S| exp[z0, z1, z2], the second
/// divided difference of exp at z = jk·vertex. It is the edge sum with its limits built in: nothing cancels at k → 0 or
/// at k perpendicular to an edge. Disc: 2πa² J1(qa)/(qa).
/// Source: Born & Wolf, Principles of Optics, 8.5; McCurdy, Ng & Parlett, Math. Comp. 43 (1984) 501.
/// Inputs: kx, ky in rad per unit of length, finite; the unit is that of the aperture.
/// Returns: unit of length squared. The far field of a unit plane wave e^{−jkz} (Rayleigh-Sommerfeld, first kind) at a
/// point (x, y, z) of distance R is (jkz/(2πR²)) e^{−jkR} I(k x/R, k y/R).
/// Error: 1e-14 of the area for k·size ≤ 100, 1e-16·k·size of it beyond (held by Fraunhofer.*).
std::complex<double> fraunhofer_integral(const Aperture& aperture, double kx, double ky);

/// The same with a complex amplitude over the opening.
/// Formula: ∫ A(x, y) e^{+j(kx x + ky y)} dx dy by products of Gauss-Legendre rules on triangles and rings, refined
/// until two refinements agree.
/// Inputs: A smooth on the convex hull of the opening.
/// Error: 1e-13 of ∫|A| over the parts of the opening (held by Fraunhofer.Amplitude*).
/// Throws: std::runtime_error if the refinements do not agree: A varies by more than a few hundred rad.
std::complex<double> fraunhofer_integral(const Aperture& aperture,
                                         const std::function<std::complex<double>(double x, double y)>& amplitude,
                                         double kx, double ky);

/// Airy pattern: intensity of a circular aperture over that on the axis, [2 J1(x)/x]².
/// Inputs: x = k a sin θ, any finite value.   Source: Born & Wolf 8.5.2 (14).   Error: 1e-15 absolute.
double airy_intensity(double x);
/// Share of the power inside the ring x of the Airy pattern, 1 − J0² − J1².   Source: Born & Wolf 8.5.2 (18).
double airy_encircled_energy(double x);
/// Intensity of a slit over that on the axis, sinc²(x).   Inputs: x = ½ k w sin θ.
double slit_intensity(double x);

}  // namespace grimaldi
