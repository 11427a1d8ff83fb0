#pragma once
// Integrals of smooth, oscillating, complex functions, each with an estimate of its error.

#include <complex>
#include <functional>
#include <vector>

namespace grimaldi {

struct Integral {
  std::complex<double> value;
  double error = 0;     ///< estimate of |value − truth|, not below the rounding of the sum
  int evaluations = 0;  ///< of the integrand
};

/// ∫_a^b f(x) dx, adaptive: the panel with the largest estimated error is halved until the sum of the estimates is
/// below `tolerance` (or below 50 ulp of ∫|f|) or 20000 panels are in use; look at `error`.
/// Formula: Gauss-Kronrod 10/21 per panel.   Source: Piessens et al., QUADPACK (Springer 1983), routine QAG.
/// Inputs: a, b finite, f finite on [a, b]; tolerance ≥ 0, in the unit of the value; `panels` ≥ 1 equal panels to begin
/// with (an oscillating integrand: one for each period).
/// Valid: f smooth but for finitely many points; ends may be reached by a root or a logarithm.
/// Error: `error` bounds the truth for the functions of tests/validation/quadrature_test.cpp.
Integral integrate(const std::function<std::complex<double>(double)>& f, double a, double b, double tolerance,
                   int panels = 1);

/// ∫_{−∞}^{∞} f(x) dx of a function that is analytic near the real line and falls off at least like exp(−e^{|x|}) or
/// exp(−x²) beyond |x| ≤ reach.
/// Formula: trapezoidal rule on [−reach, reach], step halved until two results agree within tolerance or 16 ulp
/// of ∫|f|; converges geometrically.   Source: Trefethen & Weideman, SIAM Review 56 (2014) 385.
/// Inputs: reach > 0, outside which f is negligible; tolerance as above; step > 0 to begin with.
/// Error: `error` = difference of the last two results; infinity if 14 halvings do not suffice.
Integral integrate_line(const std::function<std::complex<double>(double)>& f, double reach, double tolerance,
                        double step);

struct QuadratureNode {
  double x, weight;
};

/// Nodes and weights of the Gauss-Legendre rule on [−1, 1], ascending in x. Computed once for each n.
/// Formula: zeros of P_n by Newton from Tricomi's guess, weights 2/((1 − x²) P_n'²).
/// Inputs: 1 ≤ n ≤ 256.   Error: 2e-16 per node, 1e-15 per weight relative.
const std::vector<QuadratureNode>& gauss_legendre(int n);

}  // namespace grimaldi
