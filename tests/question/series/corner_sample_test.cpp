// The corners of a box of parameters that are tried first.
#include "question/series/corner_sample.hpp"

#include <gtest/gtest.h>

#include <set>

namespace gearlash::corner_sample_test {
namespace {

/// Of the parameters `which`, the combinations of ends that occur.
std::size_t combinations(std::size_t parameters, const std::vector<std::size_t>& which) {
  std::set<std::vector<bool>> seen;
  for (const std::vector<bool>& ends : corner_sample(parameters)) {
    std::vector<bool> some;
    for (const std::size_t i : which) some.push_back(ends[i]);
    seen.insert(some);
  }
  return seen.size();
}

TEST(PropertyCornerSample, HasAllCombinationsOfAnyThreeEnds) {
  for (std::size_t parameters = 3; parameters <= 8; ++parameters) {
    EXPECT_EQ(corner_sample(parameters).size(), parameters == 3 ? 8U : 16U);
    for (std::size_t a = 0; a < parameters; ++a) {
      for (std::size_t b = a + 1; b < parameters; ++b) {
        for (std::size_t c = b + 1; c < parameters; ++c) {
          EXPECT_EQ(combinations(parameters, {a, b, c}), 8U) << parameters << a << b << c;
        }
      }
    }
  }
}

TEST(EdgeCornerSample, OfFewParametersHasAllCorners) {
  EXPECT_EQ(corner_sample(1).size(), 2U);
  EXPECT_EQ(combinations(1, {0}), 2U);
  EXPECT_EQ(combinations(4, {0, 1, 2, 3}), 16U);
  EXPECT_EQ(corner_sample(11).size(), 16U);
  EXPECT_EQ(corner_sample(11)[5].size(), 11U);
}

}  // namespace
}  // namespace gearlash::corner_sample_test
