// The port of the 1960 program against the thesis's own printout.
#include <gtest/gtest.h>

#include <cmath>

#include "thesis/float_1604.hpp"
#include "thesis/printout.hpp"

namespace gearlash::thesis::table_2_test {
namespace {

template <class Number>
int numbers_reproduced() {
  return reproduction_of(printout<Number>(listed_parameters, thesis_table_2().size())).exact;
}

TEST(OracleTableTwo, IsWhole) {
  ASSERT_EQ(thesis_table_2().size(), 38U);
  EXPECT_EQ(printed_text(thesis_table_2()[0][1]), "77040630- 1");
  EXPECT_EQ(printed_text(thesis_table_2()[28][1]), "-76981710- 1");
  EXPECT_EQ(printed_text(thesis_table_2()[37][4]), "15964323 1");
}

TEST(OracleTableTwo, PortInDoublePrecisionIsWithinAUnitOfTheEighthDigit) {
  const auto& printed = thesis_table_2();
  const std::vector<PrintedLine> lines = printout<double>(listed_parameters, printed.size());
  int within_one = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const PrintedLine& line = lines[i];
    const std::array<double, 5> values{line.time, line.motor_speed, line.motor_position,
                                       line.load_speed, line.load_position};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const PrintedNumber cut_off = printed_number(values[k]);
      const double apart = cut_off.exponent == printed[i][k].exponent
                               ? std::abs(cut_off.digits - printed[i][k].digits)
                               : std::abs(units_apart(values[k], printed[i][k]));
      // The two others are motor speeds beside a zero crossing, where the eighth digit is finer.
      EXPECT_LE(apart, 5.0) << i << " " << k;
      if (apart <= 1.0) ++within_one;
      if (apart > 1.0) {
        EXPECT_EQ(k, 1U) << i;
        EXPECT_LT(std::abs(values[k]), 0.1) << i;
      }
    }
    EXPECT_EQ(line.at_contact, i == 30);
  }
  EXPECT_EQ(within_one, 188);
}

TEST(OracleTableTwo, OnlySumsWithoutGuardDigitsGiveTheDigitsPrinted) {
  constexpr auto cut = LengthRule::truncated;
  constexpr auto round = LengthRule::rounded;
  constexpr auto shifted = SumRule::no_guard_digits;
  EXPECT_EQ((numbers_reproduced<Number1604<FloatRules{shifted, cut, cut}>>()), 189);
  EXPECT_EQ((numbers_reproduced<Number1604<FloatRules{shifted, cut, round}>>()), 189);
  EXPECT_EQ((numbers_reproduced<Number1604<FloatRules{shifted, round, cut}>>()), 189);
  EXPECT_EQ((numbers_reproduced<Number1604<FloatRules{shifted, round, round}>>()), 189);
  EXPECT_LE((numbers_reproduced<Number1604<FloatRules{SumRule::exact_truncated, cut, cut}>>()),
            170);
  EXPECT_LE((numbers_reproduced<Number1604<FloatRules{SumRule::exact_rounded, cut, cut}>>()), 149);
}

}  // namespace
}  // namespace gearlash::thesis::table_2_test
