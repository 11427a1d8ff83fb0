#include "propagation/edge_ends.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "propagation/laws/free_space_diffraction.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Argument of a term beyond which the ends of the edge next to it no longer couple with it; a fade from 1 less.
constexpr double coupled_end = 2;

/// Power of an end's wave below which the coupling does not count.
constexpr double negligible_end = 1e-4;

}  // namespace

EndWeights::EndWeights(const Wedge& wedge, const EdgePassage& passage, double wavelength, double wavenumber,
                       bool mirrors)
    : inside_(passage.inside ? 1.0 : 0.0) {
  if (!mirrors || !wedge.stands_at_start) add(passage.detour_start, 1, wavelength, wavenumber, passage.along >= 0);
  if (!mirrors || !wedge.stands_at_end)
    add(passage.detour_end, -1, wavelength, wavenumber, passage.along <= wedge.length);
}

void EndWeights::add(double detour, double side, double wavelength, double wavenumber, bool inside) {
  ends_[count_++] = {side, std::sqrt(wavenumber * detour), !inside,
                     edge_end_wave(detour, wavelength, wavenumber, inside)};
}

Complex EndWeights::of(const EdgeTerm& term) const {
  Complex weight = inside_;
  for (const End& end : std::span(ends_.data(), count_))
    weight += edge_end_share(term.wave.argument, end.argument) * end.wave;
  return weight;
}

Complex EndWeights::of_pair(Complex weight, double alone, const EdgeTerm& other, double coupling) const {
  if (other.wave.argument >= coupled_end) return weight;
  const double near = std::min(coupled_end - other.wave.argument, 1.0);
  Complex coupled = inside_;
  const double root = std::sqrt((1 - coupling) * (1 + coupling));
  for (std::size_t i = 0; i < count_; ++i) {
    const End& end = ends_[i];
    const double w = end.side * coupling, b = other.sign * other.wave.argument;
    const double share = edge_end_share(alone, root * (end.dark ? end.argument : -end.argument) + w * b);
    if (share * std::norm(end.wave) * std::abs(w) < negligible_end) {
      coupled += share * end.wave;
      continue;
    }
    const Complex both = end_and_edge_wave(end.argument, end.dark, other.wave.argument, other.sign > 0, w);
    coupled += share / other.sign * both / other.wave.wave * std::polar(1.0, -end.argument * end.argument);
  }
  return weight + near * (coupled - weight);
}

bool couple_with_ends(const EdgeTerms& terms) {
  return std::any_of(terms.begin(), terms.end(), [](const EdgeTerm& t) { return t.wave.argument < coupled_end; });
}

}  // namespace grimaldi
