#include "question/series/corner_sample.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "base/lists.hpp"

namespace gearlash {

std::vector<std::vector<bool>> corner_sample(std::size_t parameters) {
  // A parameter is at its upper end where these bits of the corner's number have an odd sum.
  constexpr std::array<unsigned, 8> bits = {1, 2, 4, 8, 7, 14, 13, 11};
  const std::size_t count = std::size_t{1} << std::min<std::size_t>(parameters, 4);
  return of_each(indices(count), [&](std::size_t corner) {
    return of_each(indices(parameters), [&](std::size_t i) {
      return std::popcount(corner & bits[i % bits.size()]) % 2 != 0;
    });
  });
}

}  // namespace gearlash
