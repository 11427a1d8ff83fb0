#pragma once
// What the references of edges return.

#include <complex>

namespace grimaldi {

/// Total field by the condition on the faces.
struct WedgeField {
  std::complex<double> soft;  ///< Dirichlet, u = 0: E along the edge on a perfect conductor
  std::complex<double> hard;  ///< Neumann, ∂u/∂n = 0: H along the edge, sound at a rigid wall
};

}  // namespace grimaldi
