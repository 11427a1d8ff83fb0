#include "propagation/chain_steps.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Slopes count so many times the plain factor at the most, where both couplings of an edge multiply them.
constexpr double steepest = 4;

/// slope/plain.
double steepness(const EdgeTerm& term) {
  return term.slope > steepest * term.plain ? steepest : term.slope / term.plain;
}

/// Factors from a wave at one edge to that at the next.
struct Step {
  Complex whole, slope;                        ///< to the next `whole`, from either
  Complex slope_from_whole, slope_from_slope;  ///< to the next `slope`
};

/// The first two edges, in factors of what meets the first. `slope2`: of the second's term.
Step first_step(const EdgeTerm& first, const EdgeTerm& second, double slope2, double coupling) {
  const double slopes = first.slope * slope2 * first.sign * second.sign;
  const auto moments = double_edge_moments(first.wave, second.wave, signed_coupling(first, second, coupling));
  const Complex mean = second.wave.slope / second.wave.wave;
  return {first.value() * second.value() + slopes * moments.excess, 0,
          slopes * (moments.second - mean * moments.excess), 0};
}

/// From an edge that is not the first to the next.
Step next_step(const EdgeTerm& first, const EdgeTerm& second, double slope2, double coupling) {
  const double slopes = steepness(first) * slope2 * second.sign;
  const auto moments = double_edge_moments(first.wave, second.wave, signed_coupling(first, second, coupling));
  const Complex mean1 = first.wave.slope / first.wave.wave, mean2 = second.wave.slope / second.wave.wave;
  const Complex own = slopes / first.wave.wave,
                beyond = slopes / (second_moment(first.wave) - mean1 * first.wave.slope);
  return {second.value() + own * moments.excess, beyond * (moments.first - mean1 * moments.excess),
          own * (moments.second - mean2 * moments.excess),
          beyond * (moments.both - mean1 * moments.second - mean2 * (moments.first - mean1 * moments.excess))};
}

void add(const Complex& factor, const ConeField& wave, ConeField& into) {
  for (std::size_t p = 0; p < 2; ++p) into[p] += factor * wave[p];
}

void multiply(ConeField& wave, const Complex& factor) {
  for (Complex& component : wave) component *= factor;
}

}  // namespace

void PairSteps::meet(std::size_t number, const EndWeights& ends) {
  number_ = number;
  ends_before_ = ends_;
  weights_before_ = weights_;
  ends_ = ends;
  const EdgeTerms& terms = terms_[number];
  for (std::size_t t = 0; t < terms.count; ++t) weights_[t] = ends.of(terms.term[t]);
  ends_couple_ = number == 1 && (couple_with_ends(terms_[0]) || couple_with_ends(terms));
}

Complex PairSteps::coupled_ends(std::size_t a, std::size_t t) const {
  const EdgeTerm &one = terms_[0].term[a], &two = terms_[1].term[t];
  const double coupling = chain_.coupling[0];
  const double apart = 1 / std::sqrt(std::max((1 - coupling) * (1 + coupling), 1e-12));
  const double w = -coupling * one.lit_out * two.lit_in;
  const double q1 = one.sign * one.wave.argument, q2 = two.sign * two.wave.argument;
  return ends_before_->of_pair(weights_before_[a], apart * (q1 + w * q2), two, -two.lit_in * chain_.end_coupling[0]) *
         ends_->of_pair(weights_[t], apart * (q2 + w * q1), one, one.lit_out * chain_.end_coupling[1]);
}

void PairSteps::pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const {
  // The first of two edges leaves its factors and weights to the pairs with the second.
  Complex factor = 1;
  if (number_ == 1)
    factor = pair_wave(terms_[0].term[a], terms_[1].term[t], chain_.coupling[0]) *
             (ends_couple_ ? coupled_ends(a, t) : weights_before_[a]);
  else if (edges_ == 1)
    factor = terms_[0].term[t].value();
  add(factor, wave[0], into[0]);
}

void PairSteps::leave(std::size_t t, std::span<ConeField> wave) const {
  if (!ends_couple_ && number_ + 1 == edges_) multiply(wave[0], weights_[t]);
}

void MomentSteps::meet(std::size_t number, const EndWeights& ends) {
  number_ = number;
  const EdgeTerms& terms = terms_[number];
  for (std::size_t t = 0; t < terms.count; ++t) weights_[t] = ends.of(terms.term[t]);
}

void MomentSteps::pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const {
  if (number_ == 0) {
    add(1, wave[0], into[0]);
    return;
  }
  const EdgeTerm &first = terms_[number_ - 1].term[a], &second = terms_[number_].term[t];
  const double coupling = chain_.coupling[number_ - 1];
  const double slope = number_ + 1 < edges_ ? std::min(second.slope, steepest * second.plain) : second.slope;
  const Step step =
      number_ == 1 ? first_step(first, second, slope, coupling) : next_step(first, second, slope, coupling);
  add(step.whole, wave[0], into[0]);
  add(step.slope_from_whole, wave[0], into[1]);
  if (number_ == 1) return;
  add(step.slope, wave[1], into[0]);
  add(step.slope_from_slope, wave[1], into[1]);
}

void MomentSteps::leave(std::size_t t, std::span<ConeField> wave) const {
  for (std::size_t i = 0; i < leaving(t); ++i) multiply(wave[i], weights_[t]);
}

RowSteps::RowSteps(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges)
    : chain_(chain), terms_(terms), edges_(edges) {
  row_rests(std::span(chain.coupling.data(), edges - 1), std::span(rests_.data(), edges));
}

void RowSteps::meet(std::size_t number, const EndWeights& ends) {
  number_ = number;
  std::swap(here_, before_);
  const EdgeTerms& terms = terms_[number];
  for (std::size_t t = 0; t < terms.count; ++t) {
    const EdgeTerm& term = terms.term[t];
    here_[t] = row_aperture(term.wave.argument, chain_.width[number]);
    // The plain factors of the outer edges are in the kernels.
    weights_[t] = term.sign * (number == 0 || number + 1 == edges_ ? 1 : term.plain) * ends.of(term);
  }
}

void RowSteps::pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const {
  const RowAperture& here = here_[t];
  if (number_ == 0) {
    for (std::size_t l = 0; l < here.count; ++l)
      add(std::exp(-rests_[0] * here.place[l] * here.place[l]), wave[0], into[l]);
    return;
  }
  const EdgeTerm &first = terms_[number_ - 1].term[a], &second = terms_[number_].term[t];
  const bool begins = number_ == 1, ends = number_ + 1 == edges_;
  const double plain = (begins ? first.plain : 1) * (ends ? second.plain : 1);
  const double slope = (begins ? first.slope : steepness(first)) * (ends ? second.slope : steepness(second));
  std::array<double, most_row_nodes * most_row_nodes> kernel;
  row_kernel(before_[a], here, {signed_coupling(first, second, chain_.coupling[number_ - 1]), rests_[number_]}, plain,
             slope, kernel);
  const std::size_t from = before_[a].count;
  for (std::size_t l = 0; l < here.count; ++l) {
    const double* row = kernel.data() + l * from;
    double sum[4] = {0, 0, 0, 0};
    for (std::size_t k = 0; k < from; ++k) {
      sum[0] += row[k] * wave[k][0].real();
      sum[1] += row[k] * wave[k][0].imag();
      sum[2] += row[k] * wave[k][1].real();
      sum[3] += row[k] * wave[k][1].imag();
    }
    into[l][0] += Complex(sum[0], sum[1]);
    into[l][1] += Complex(sum[2], sum[3]);
  }
}

void RowSteps::leave(std::size_t t, std::span<ConeField> wave) const {
  const RowAperture& here = here_[t];
  for (std::size_t l = 0; l < here.count; ++l) multiply(wave[l], weights_[t] * here.weight[l]);
  if (number_ + 1 < edges_) return;
  for (std::size_t l = 1; l < here.count; ++l) add(1, wave[l], wave[0]);
}

bool is_row(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges) {
  constexpr double least_argument = 0.7, strong = 0.05;
  if (edges < 3) return false;
  std::array<double, max_edges> q;
  for (std::size_t e = 0; e < edges; ++e) {
    if (!row_fits(chain.width[e])) return false;
    q[e] = terms[e].term[0].wave.argument;
    for (const EdgeTerm& term : terms[e]) q[e] = std::min(q[e], term.wave.argument);
    q[e] = std::max(q[e], least_argument);
  }
  for (std::size_t e = 1; e + 1 < edges; ++e) {
    const double z1 = std::abs(chain.coupling[e - 1]) / (2 * q[e - 1] * q[e]);
    const double z2 = std::abs(chain.coupling[e]) / (2 * q[e] * q[e + 1]);
    if (z1 * z2 >= strong) return true;
  }
  return false;
}

}  // namespace grimaldi
