#include "validation/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Function = std::function<Complex(double)>;

constexpr double ulp = std::numeric_limits<double>::epsilon();
constexpr std::size_t most_panels = 20000;
constexpr int most_halvings = 14;

// The 21-point rule of Kronrod (nodes ≥ 0; the odd places belong to the 10-point rule of Gauss), from QUADPACK's dqk21.
constexpr std::array<double, 11> kronrod_nodes = {0.995657163025808080735527280689003,
                                                  0.973906528517171720077964012084452,
                                                  0.930157491355708226001207180059508,
                                                  0.865063366688984510732096688423493,
                                                  0.780817726586416897063717578345042,
                                                  0.679409568299024406234327365114874,
                                                  0.562757134668604683339000099272694,
                                                  0.433395394129247190799265943165784,
                                                  0.294392862701460198131126602103866,
                                                  0.148874338981631210884826001129720,
                                                  0.0};
constexpr std::array<double, 11> kronrod_weights = {
    0.011694638867371874278064396062192, 0.032558162307964727478818972459390, 0.054755896574351996031381300244580,
    0.075039674810919952767043140916190, 0.093125454583697605535065465083366, 0.109387158802297641899210590325805,
    0.123491976262065851077958109585166, 0.134709217311473325928054001771707, 0.142775938577060080797094273138717,
    0.147739104901338491374841515972068, 0.149445554002916905664936468389821};
constexpr std::array<double, 5> gauss_weights = {
    0.066671344308688137593568809893332, 0.149451349150580593145863396957658, 0.219086362515982043995534934228163,
    0.269266719309996355091226921569469, 0.295524224714752870173815619188769};

struct Panel {
  double a, b;
  Complex value;
  double error, modulus;  // estimate; ∫|f|
};

Panel evaluate(const Function& f, double a, double b) {
  const double centre = (a + b) / 2, half = (b - a) / 2;
  std::array<Complex, 21> values;
  values[20] = f(centre);
  Complex kronrod = kronrod_weights[10] * values[20], gauss = 0;
  double modulus = kronrod_weights[10] * std::abs(values[20]);
  for (std::size_t i = 0; i < 10; ++i) {
    const double x = half * kronrod_nodes[i];
    const Complex left = values[2 * i] = f(centre - x), right = values[2 * i + 1] = f(centre + x);
    kronrod += kronrod_weights[i] * (left + right);
    modulus += kronrod_weights[i] * (std::abs(left) + std::abs(right));
    if (i % 2 == 1) gauss += gauss_weights[i / 2] * (left + right);
  }
  // QUADPACK's estimate: the difference of the rules overstates the error of the better one; it is scaled by the
  // spread of f about its mean.
  const Complex mean = kronrod / 2.0;
  double spread = kronrod_weights[10] * std::abs(values[20] - mean);
  for (std::size_t i = 0; i < 10; ++i)
    spread += kronrod_weights[i] * (std::abs(values[2 * i] - mean) + std::abs(values[2 * i + 1] - mean));
  double error = std::abs(kronrod - gauss);
  if (spread > 0) error = spread * std::min(1.0, std::pow(200 * error / spread, 1.5));
  return {a, b, kronrod * half, std::max(error, 2 * ulp * modulus) * std::fabs(half), modulus * std::fabs(half)};
}

}  // namespace

Integral integrate(const Function& f, double a, double b, double tolerance, int panels) {
  GRIMALDI_EXPECT(std::isfinite(a) && std::isfinite(b) && tolerance >= 0 && panels >= 1);
  const auto less = [](const Panel& p, const Panel& q) { return p.error < q.error; };
  std::vector<Panel> heap;  // the largest error in front
  double error = 0, modulus = 0;
  int evaluations = 0;
  const auto add = [&](double from, double to) {
    heap.push_back(evaluate(f, from, to));
    std::push_heap(heap.begin(), heap.end(), less);
    evaluations += 21;
  };
  for (int i = 0; i < panels; ++i) add(a + (b - a) * i / panels, i + 1 == panels ? b : a + (b - a) * (i + 1) / panels);
  for (const Panel& panel : heap) error += panel.error, modulus += panel.modulus;
  while (error > std::max(tolerance, 50 * ulp * modulus) && heap.size() < most_panels) {
    std::pop_heap(heap.begin(), heap.end(), less);
    const Panel worst = heap.back();
    heap.pop_back();
    const double middle = (worst.a + worst.b) / 2;
    if (middle == worst.a || middle == worst.b) {
      heap.push_back(worst);
      break;  // a panel of two neighbouring doubles
    }
    const Panel left = evaluate(f, worst.a, middle), right = evaluate(f, middle, worst.b);
    evaluations += 42;
    for (const Panel& panel : {left, right}) {
      heap.push_back(panel);
      std::push_heap(heap.begin(), heap.end(), less);
    }
    error += left.error + right.error - worst.error;
    modulus += left.modulus + right.modulus - worst.modulus;
  }
  Integral result{0, 0, evaluations};
  for (const Panel& panel : heap) result.value += panel.value, result.error += panel.error;
  return result;
}

Integral integrate_line(const Function& f, double reach, double tolerance, double step) {
  GRIMALDI_EXPECT(reach > 0 && tolerance >= 0 && step > 0);
  Complex sum = f(0);
  double modulus = std::abs(sum);
  int evaluations = 1;
  const auto add = [&](double x) {
    const Complex left = f(-x), right = f(x);
    sum += left + right;
    modulus += std::abs(left) + std::abs(right);
    evaluations += 2;
  };
  double h = step;
  for (int i = 1; i * h <= reach; ++i) add(i * h);
  Complex value = sum * h;
  for (int halving = 0; halving < most_halvings; ++halving) {
    h /= 2;
    for (int i = 1; i * h <= reach; i += 2) add(i * h);
    const double error = std::max(std::abs(sum * h - value), ulp * modulus * h);
    value = sum * h;
    if (error <= std::max(tolerance, 16 * ulp * modulus * h)) return {value, error, evaluations};
  }
  return {value, std::numeric_limits<double>::infinity(), evaluations};
}

const std::vector<QuadratureNode>& gauss_legendre(int n) {
  GRIMALDI_EXPECT(n >= 1 && n <= 256);
  static std::mutex mutex;
  static std::map<int, std::vector<QuadratureNode>> rules;  // a node of a map stays where it is
  const std::lock_guard lock(mutex);
  std::vector<QuadratureNode>& rule = rules[n];
  if (!rule.empty()) return rule;
  rule.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (before - x * p) / ((1 - x) * (1 + x));
      x -= p / slope;
    }
    if (2 * i + 1 == n) x = 0;
    const double weight = 2 / ((1 - x) * (1 + x) * slope * slope);
    rule[static_cast<std::size_t>(i)] = {-x, weight};
    rule[static_cast<std::size_t>(n - 1 - i)] = {x, weight};
  }
  return rule;
}

}  // namespace grimaldi
