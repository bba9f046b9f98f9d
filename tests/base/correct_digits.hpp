// Scores of what is found beside what is known, in correct digits.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gearlash {

/// −log₁₀ of the relative error, 17 at most. Precondition: known ≠ 0.
inline double correct_digits(double found, double known) {
  return -std::log10(std::max(std::abs(found / known - 1.0), 1e-17));
}

/// Expects a score, and records it under the name of the quantity in the test's report.
inline void expect_digits(const std::string& quantity, double found, double known, double least) {
  const double score = correct_digits(found, known);
  testing::Test::RecordProperty("digits_of_" + quantity, std::to_string(score));
  EXPECT_GE(score, least) << quantity << " is " << found << ", known as " << known;
}

}  // namespace gearlash
