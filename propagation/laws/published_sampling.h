#pragma once
// Directions drawn from the wave of one edge as its authors published it (Steinberg et al. 2024): exactly from its
// intensity, without tables. exp(−iωt).
//
// In the edge's own coordinates ζ the intensity is |A g1(ζx) + iB g2(ζx)|² ζy²/ζ⁴ (1 − e^{−ζ²/6})/4π², A = a − b, B =
// (a
// + b)/2. Its part odd in ζx decides the sign of ζx alone; |ζx| follows |A|² g1² K + |B|² g2² K, K the integral over
// ζy; ζy given ζx has a law of its own. Each is drawn by rejection from a power law.

#include <functional>

#include "propagation/laws/published_diffraction.h"

namespace grimaldi {

/// K(x) = ∫ y²/(x² + y²)² (1 − e^{−(x²+y²)/6}) dy = π/(2x) erf(x/√6) − (πx/6) erfc(x/√6) + √(π/6) e^{−x²/6}.
/// Inputs: x ≥ 0. Returns ≤ K(0) = 2√(π/6) and ≤ π/(2x). Error: 1e-15 absolute.
double lobe_integral(double x);

/// The law of directions of one edge without its central lobe.
class PublishedEdgeLaw {
 public:
  /// Inputs: wavenumber rad/m; an edge of length > 0 whose amplitudes are not both 0.
  PublishedEdgeLaw(double wavenumber, const PublishedEdge& edge);

  /// ξ with `density`; may lie outside the unit disc. `uniform` gives independent numbers uniform in (0, 1): 9 in
  /// the mean (1.5 tries for ζx, at most 1.6 for ζy). Held by PublishedSampling.*.
  PlanePoint draw(const std::function<double()>& uniform) const;

  /// |R ψ̂_j(ξ)|² over the edge's power (S2.33), per d²ξ; its integral over the plane is 1.
  double density(const PlanePoint& xi) const;

 private:
  double wavenumber_, power_, varying_share_;
  PublishedEdge edge_;
  std::complex<double> difference_, mean_;  ///< A, B
};

}  // namespace grimaldi
