#include "base/arithmetic.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <string>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace gearlash::arithmetic_test {
namespace {

/// What is found with another rounding mode.
std::string fault_with(int mode) {
  const int before = std::fegetround();
  std::fesetround(mode);
  const std::string fault(fault_of_arithmetic());
  std::fesetround(before);
  return fault;
}

TEST(Arithmetic, IsThatOfIntervals) {
  EXPECT_EQ(fault_of_arithmetic(), "");
  EXPECT_TRUE(proves());
}

TEST(EdgeArithmetic, OfAnotherRoundingModeProvesNothing) {
  EXPECT_EQ(fault_with(FE_TONEAREST), "");
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_EQ(fault_with(mode), "this thread does not round to the nearest number") << mode;
  }
}

#ifdef __SSE2__
/// Results below the normal numbers become 0 (bit 15), operands (bit 6).
TEST(EdgeArithmetic, ThatFlushesSubnormalNumbersProvesNothing) {
  const unsigned before = _mm_getcsr();
  for (const unsigned bit : {1U << 15U, 1U << 6U}) {
    _mm_setcsr(before | bit);
    const std::string fault(fault_of_arithmetic());
    _mm_setcsr(before);
    EXPECT_EQ(fault, "this thread takes numbers below 2.2e-308 for 0") << bit;
  }
}
#endif

}  // namespace
}  // namespace gearlash::arithmetic_test
