#include "question/series/corner_sample.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace gearlash {

std::vector<std::vector<bool>> corner_sample(std::size_t parameters) {
  // A parameter is at its upper end where these bits of the corner's number have an odd sum.
  constexpr std::array<unsigned, 8> bits = {1, 2, 4, 8, 7, 14, 13, 11};
  const unsigned count = 1U << std::min<std::size_t>(parameters, 4);
  std::vector<std::vector<bool>> corners;
  for (unsigned corner = 0; corner < count; ++corner) {
    std::vector<bool>& ends = corners.emplace_back();
    for (std::size_t i = 0; i < parameters; ++i) {
      ends.push_back(std::popcount(corner & bits[i % bits.size()]) % 2 != 0);
    }
  }
  return corners;
}

}  // namespace gearlash
