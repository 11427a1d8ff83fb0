#include "propagation/laws/slab_table.h"

#include <algorithm>
#include <cmath>

#include "core/contract.h"

namespace grimaldi {
namespace {

constexpr double largest_error = 1e-10;
constexpr std::size_t fewest_pieces = 16, most_pieces = 2048;

std::array<double, 4> numbers(const ReflectionCoefficients& r) {
  return {r.te.real(), r.te.imag(), r.tm.real(), r.tm.imag()};
}

}  // namespace

SlabTable::SlabTable(std::complex<double> permittivity, double thickness, double wavenumber)
    : permittivity_(permittivity), thickness_(thickness), wavenumber_(wavenumber) {
  for (std::size_t pieces = fewest_pieces; pieces <= most_pieces; pieces *= 2)
    if (fill(pieces)) return;
  pieces_.clear();
}

/// False if a piece misses the error between its nodes.
bool SlabTable::fill(std::size_t pieces) {
  const auto& t = nodes;
  pieces_.resize(pieces);
  for (std::size_t p = 0; p < pieces; ++p) {
    const auto cosine = [&](double at) { return std::clamp((double(p) + 0.5 * (at + 1)) / double(pieces), 0.0, 1.0); };
    Piece& c = pieces_[p];
    for (std::size_t i = 0; i < points; ++i)
      c[i] = numbers(slab_reflection(permittivity_, thickness_, wavenumber_, cosine(t[i])));
    for (std::size_t order = 1; order < points; ++order)
      for (std::size_t i = points - 1; i >= order; --i)
        for (std::size_t k = 0; k < 4; ++k) c[i][k] = (c[i][k] - c[i - 1][k]) / (t[i] - t[i - order]);
    for (std::size_t i = 0; i <= points; ++i) {
      const double at = i == 0 ? -1 : i == points ? 1 : 0.5 * (t[i - 1] + t[i]);
      const double c_at = std::min(cosine(at), std::nextafter(double(p + 1) / double(pieces), 0.0));
      const auto exact = numbers(slab_reflection(permittivity_, thickness_, wavenumber_, c_at)),
                 found = numbers(read(c_at));
      for (std::size_t k = 0; k < 4; ++k)
        if (!(std::abs(found[k] - exact[k]) <= largest_error)) return false;
    }
  }
  return true;
}

ReflectionCoefficients SlabTable::read(double cos_incidence) const {
  const auto& t = nodes;
  const double x = cos_incidence * double(pieces_.size());
  const std::size_t p = std::min(static_cast<std::size_t>(x), pieces_.size() - 1);
  const double at = 2 * (x - double(p)) - 1;
  const Piece& c = pieces_[p];
  std::array<double, 4> sum = c[points - 1];
  for (std::size_t i = points - 1; i-- > 0;)
    for (std::size_t k = 0; k < 4; ++k) sum[k] = sum[k] * (at - t[i]) + c[i][k];
  return {{sum[0], sum[1]}, {sum[2], sum[3]}};
}

ReflectionCoefficients SlabTable::operator()(double cos_incidence) const {
  GRIMALDI_EXPECT(cos_incidence >= 0 && cos_incidence <= 1);
  return pieces_.empty() ? slab_reflection(permittivity_, thickness_, wavenumber_, cos_incidence) : read(cos_incidence);
}

}  // namespace grimaldi
