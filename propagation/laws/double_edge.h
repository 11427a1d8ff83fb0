#pragma once
// The wave that two straight edges diffract one after the other, uniform through both transition regions. exp(+jωt).
//
// Legs s₁ (source to edge 1), s₁₂, s₂ (edge 2 to receiver). Each edge has the argument q = √(2kL) sin β |sin(ε/2)| that
// it has for its neighbours as source and receiver, ε the turn beyond the boundary (> 0: dark). One edge alone has the
// wave U(q) = ½ w(e^{3jπ/4} q), − on the lit side.

#include <complex>

namespace grimaldi {

/// How far the second edge lies in the transition region of the first: the correlation of the two apertures.
/// Formula: w = √(s₁ s₂/((s₁+s₁₂)(s₁₂+s₂))), times the cosine of the angle between the edges' normals across the ray
/// between them; negative where the screens stand on opposite sides of that ray.
/// Inputs: legs > 0, m (∞ is allowed for s₁ and s₂).   Returns: 0 … 1 for parallel edges.
double edge_coupling(double before, double between, double behind);

/// Wave over two edges over the product of the amplitudes that each has alone.
/// Formula: U₂ = (j/π) ∫₀^∞ ∫₀^∞ exp(−j(t₁² + t₂² − 2w t₁t₂) − 2j(q₁t₁ + q₂t₂)) dt₁ dt₂, times the signs σ₁σ₂ (dark +,
/// lit −) with w replaced by σ₁σ₂w. The field is U₂ √(1−w²) e^{−jk(s₁+s₁₂+s₂)}/(s₁+s₁₂+s₂) for a point source of unit
/// amplitude and parallel edges.
/// * w = 0: U(q₁) U(q₂), to which it also tends for q₁q₂ ≫ |w|.
/// * q₁ = q₂ = 0: (¼ + asin(w)/2π)/√(1−w²).
/// * Where q₁ passes 0, √(1−w²) U₂ changes by U(q₂/√(1−w²)): the wave of edge 2 alone, which ends or begins there.
/// Source: the paraxial double Fresnel integral (Millington, Hewitt & Immirzi 1962) with the single waves taken away;
/// own reduction: √(1−w²) U₂ = g(x₁, q₂) + g(x₂, q₁), x₁ = (q₁ + w q₂)/√(1−w²), x₂ likewise, with the generalised
/// Fresnel integral g(x, y) = (x/2π) ∫_y^∞ e^{−j(t²−y²)}/(x²+t²) dt (Clemmow & Senior 1953; Owen's T function of
/// complex argument), g(x, y) + g(y, x) = U(x) U(y). Of the use: Capolino & Albani 1997, Albani 2005.
/// Inputs: q ≥ 0; −1 < w < 1.   Returns: dimensionless.
/// Error: ≤ 1e-11/√(1−w²) absolute (held by DoubleEdge.AgainstQuadrature).
std::complex<double> double_edge_wave(double q1, bool dark1, double q2, bool dark2, double coupling);

/// One edge's part in the wave over two.
struct EdgeWave {
  double argument;             ///< q ≥ 0
  std::complex<double> wave;   ///< U(q) = ½ w(e^{3jπ/4} q)
  std::complex<double> slope;  ///< √(j/π) ∫₀^∞ t e^{−jt²−2jqt} dt = (j/2) dU/dq
};

/// Error: of U that of faddeeva_on_ray; of the slope 1e-12 relative.
EdgeWave make_edge_wave(double argument);

/// The same from U(q) at hand.
EdgeWave make_edge_wave(double argument, std::complex<double> wave);

/// What the coupling adds to the product of two waves: U₂ − U(q₁)U(q₂), both dark (for the signs see above).
/// Formula: Σ_{n≥1} (2jw)ⁿ/n! I_n(q₁) I_n(q₂) in the repeated integrals of U, whose first term is 2jw times the product
/// of the slopes. That term alone where z = |w|/(2q₁q₂) < 0.004 (a q below 0.7 taken as 0.7), three terms where
/// z < 0.02, else U₂ as above.
/// Inputs: −1 < w < 1.
/// Error: ≤ 1e-4 |U(q₁)U(q₂)| + 1e-11/(1−w²); of the part odd in w 1e-3 of itself (held by DoubleEdge.Excess*).
std::complex<double> double_edge_excess(const EdgeWave& first, const EdgeWave& second, double coupling);

/// An excess as above and the same weighted with the displacement t beyond either edge: what a third edge, on the far
/// side of that one, couples with.
struct DoubleEdgeMoments {
  std::complex<double> excess;
  std::complex<double> first, second;  ///< weighted with t₁ or t₂
  std::complex<double> both;           ///< with t₁t₂
};

/// Formula: Σ_{n≥1} (2jw)ⁿ/n! I_n(q₁) I_n(q₂), I_{n+1}(q₁) I_n(q₂) and I_n(q₁) I_{n+1}(q₂) in its place. The whole
/// moments, n = 0 with them, are M₁ = (e^{−jπ/4}/(2√π) (U(q₂) + w U(q₁)) − (q₁ + w q₂) U₂)/(1−w²), and M₂ with the
/// edges exchanged (own: integration by parts). Series in the cases of `double_edge_excess`. Inputs: −1 < w < 1. Error:
/// 1e-3 of the excess, of a moment 3e-3 of itself and 1e-9/(1−w²)² (held by DoubleEdge.Moments).
DoubleEdgeMoments double_edge_moments(const EdgeWave& first, const EdgeWave& second, double coupling);

/// I₂(q) = √(j/π) ∫₀^∞ t² e^{−jt²−2jqt} dt.
std::complex<double> second_moment(const EdgeWave& wave);

/// The same wave for an end V of an edge and another edge, as the path over both edges has it: times e^{−jkδ}/U(b) of
/// V's detour δ it takes the place of V's wave there.
/// Formula: with signs (dark +), b the other edge's argument for the path, a = √(kδ): for V itself the other edge has
/// b' = √(1−w²) b − w a, and V without the other edge a' = √(1−w²) a + w b. √(1−w²) U₂(a, b'), and where b and b'
/// differ in sign ±U(a') e^{jb'²}, + if V is lit: the path over V's edge alone, with V's wave, comes and goes where b
/// changes sign, V's own way where b' does. w = 0: U(a) U(b). Source: own; the quadratic form of the double Fresnel
/// integral. Inputs: a, b ≥ 0; −1 < w < 1, both dark. Error: that of double_edge_wave.
std::complex<double> end_and_edge_wave(double end, bool end_dark, double edge, bool edge_dark, double coupling);

/// The largest amplitude that one edge's share in a wave over two can have.
/// Formula: α = √((¼ + asin|w|/2π)/√(1−w²)), the root of the largest |U₂|. With f(q) = min(α, 0.3/q):
/// |t U(q₁)U(q₂) + (U₂ − U(q₁)U(q₂))| ≤ f(q₁) f(q₂) for 0 ≤ t ≤ 1 and both signs of w.
/// Inputs: −1 < w < 1.   Returns: ½ … ∞. (Held by DoubleEdge.Bound, on a grid of q, w and t.)
double double_edge_share(double coupling);

/// f(q) of the bound above; share = α.
double double_edge_bound(double argument, double share);

}  // namespace grimaldi
