#pragma once
// Integrals over the opening of an aperture, in two dimensions.

#include <complex>
#include <functional>

#include "validation/aperture.h"
#include "validation/quadrature.h"

namespace grimaldi {

/// ∫ f(x, y) dx dy over the opening.
/// Formula: each polygon = the signed fan of triangles (apex, corner, next corner); triangles and discs by products of
/// 16-point Gauss-Legendre panels in polar-like coordinates, panels halved until two results agree within tolerance.
/// Inputs: f smooth on the convex hull of the opening and the apex; `panels` ≥ 1 to begin with, in each of the two
/// coordinates; tolerance > 0 relative to ∫|f| over the parts.
/// Error: `error` = difference of the last two results, each rule being far better than the one before.
/// Throws: std::runtime_error after 6 halvings.
Integral integrate_over(const Aperture& aperture, const std::function<std::complex<double>(double x, double y)>& f,
                        const Aperture::Point& apex, int panels, double tolerance);

}  // namespace grimaldi
