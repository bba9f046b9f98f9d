// The divided differences of exp that flights are made of lie within their enclosures.
#include "closed_form/enclosed_decays.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/references.hpp"

namespace gearlash::enclosed_decays_test {
namespace {

void expect_holds(const Interval& bounds, Wide exact) {
  ASSERT_TRUE(bounds.low <= exact && exact <= bounds.high);
}

TEST(OracleEnclosedDecays, HoldAndAreNarrow) {
  double worst_of_one = 0.0;
  double worst_of_two = 0.0;
  double widest = 0.0;
  for (const Reference& exact : References("closed_form", "divided_differences")) {
    const double x = exact.input("x");
    const double y = exact.input("y");
    if (std::max(x, y) > 600.0) continue;  // a factor that is no normal double
    SCOPED_TRACE(testing::Message() << x << " " << y);
    const BasicDecay<Interval> of_x = detail::enclosed_decay(x);
    expect_holds(of_x.factor, exact["factor"]);
    expect_holds(of_x.integral, exact["integral"]);
    expect_holds(of_x.double_integral, exact["double_integral"]);
    const auto both = detail::enclosed_convolution(of_x, detail::enclosed_decay(y));
    expect_holds(both.value, exact["joint"]);
    expect_holds(both.integral, exact["joint_integral"]);
    expect_holds(both.double_integral, exact["joint_double_integral"]);
    widest = std::max(widest, both.double_integral.width() / both.double_integral.low);
    if (x < detail::series_limit) {
      worst_of_one = std::max(
          worst_of_one, epsilons_off(detail::single_rate_series(x), exact["double_integral"]));
    }
    if (x < detail::series_limit && y < detail::series_limit) {
      worst_of_two = std::max(worst_of_two, epsilons_off(detail::two_rate_series(x, y),
                                                         exact["joint_double_integral"]));
    }
  }
  // The bounds of the header, 8 and 26 units of half an epsilon, hold with room.
  EXPECT_LE(worst_of_one, 4.0);
  EXPECT_LE(worst_of_two, 13.0);
  EXPECT_LE(widest, 400.0 * epsilon);
}

}  // namespace
}  // namespace gearlash::enclosed_decays_test
