#include "core/random.h"

namespace grimaldi {

std::array<std::uint32_t, 4> philox(const std::array<std::uint32_t, 2>& key,
                                    const std::array<std::uint32_t, 4>& counter) {
  // Multipliers and Weyl increments of Salmon et al. (golden ratio and √3 − 1, times 2³²).
  constexpr std::uint64_t multiplier0 = 0xD2511F53u, multiplier1 = 0xCD9E8D57u;
  constexpr std::uint32_t weyl0 = 0x9E3779B9u, weyl1 = 0xBB67AE85u;
  constexpr int rounds = 10;
  std::array<std::uint32_t, 4> c = counter;
  std::uint32_t key0 = key[0], key1 = key[1];
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t product0 = multiplier0 * c[0], product1 = multiplier1 * c[2];
    c = {static_cast<std::uint32_t>(product1 >> 32) ^ c[1] ^ key0, static_cast<std::uint32_t>(product1),
         static_cast<std::uint32_t>(product0 >> 32) ^ c[3] ^ key1, static_cast<std::uint32_t>(product0)};
    key0 += weyl0;
    key1 += weyl1;
  }
  return c;
}

std::array<double, 4> uniform4(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, std::uint32_t dimension) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
  const auto words = philox({low(seed), high(seed)}, {low(index), high(index), stream, dimension});
  const auto unit = [](std::uint32_t word) { return (word + 0.5) * 0x1p-32; };  // exact: 33 bits
  return {unit(words[0]), unit(words[1]), unit(words[2]), unit(words[3])};
}

}  // namespace grimaldi
