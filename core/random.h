#pragma once
// Counter-based random numbers: a value is a function of (seed, stream, index, dimension), never of an order of calls.

#include <array>
#include <cstdint>

namespace grimaldi {

/// Philox4x32-10. Source: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
/// Returns four words that are independent for distinct (key, counter). Equal to the published known-answer vectors.
std::array<std::uint32_t, 4> philox(const std::array<std::uint32_t, 2>& key,
                                    const std::array<std::uint32_t, 4>& counter);

/// Four uniform doubles in (0, 1), 32 bits each: (word + ½)/2³². `stream` separates uses of the same seed (launch, edge
/// sampling, sub-points …), `index` is the beam or cell, `dimension` the draw within it.
std::array<double, 4> uniform4(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::uint32_t dimension);

}  // namespace grimaldi
