// Decimal numbers are read to the nearest double, and refused where there is none.
#include "base/decimal.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace gearlash {
namespace {

TEST(Decimal, ReadsTheNearestDouble) {
  EXPECT_EQ(nearest_double("0.1"), 0.1);
  EXPECT_EQ(nearest_double("-2.5e3"), -2500.0);
  EXPECT_EQ(nearest_double("1e-400000000"), std::nullopt);
  EXPECT_EQ(nearest_double("0e-400"), 0.0);
  EXPECT_EQ(nearest_double("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(nearest_double("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(nearest_double("1e309"), std::nullopt);
}

}  // namespace
}  // namespace gearlash
