#pragma once
// The wedges at the rims of each patch.

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/scene.h"

namespace grimaldi {

class PatchRims {
 public:
  explicit PatchRims(const Scene& scene) : begins_(scene.patches.patches.size() + 1, 0) {
    const auto each = [&](auto&& act) {
      for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
        const Wedge& wedge = scene.wedges.wedges[w];
        act(wedge.patch0, w);
        if (wedge.patchn != wedge.patch0) act(wedge.patchn, w);
      }
    };
    each([&](std::uint32_t patch, std::uint32_t) { ++begins_[patch + 1]; });
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    wedges_.resize(begins_.back());
    std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
    each([&](std::uint32_t patch, std::uint32_t w) { wedges_[next[patch]++] = w; });
  }

  std::span<const std::uint32_t> of(std::uint32_t patch) const {
    return {wedges_.data() + begins_[patch], wedges_.data() + begins_[patch + 1]};
  }

  /// The wedge of `patch` that the number u in [0, 1) names; no_index if it has none.
  std::uint32_t pick(std::uint32_t patch, double u) const {
    const auto rims = of(patch);
    return rims.empty() ? no_index : rims[static_cast<std::size_t>(u * double(rims.size()))];
  }

 private:
  std::vector<std::uint32_t> begins_, wedges_;
};

}  // namespace grimaldi
