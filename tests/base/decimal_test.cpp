// Decimal numbers are read to the nearest double, and refused where there is none; doubles are
// written with and without the standard library in the same characters.
#include "base/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "seeded_draws.hpp"

namespace gearlash::decimal_test {
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

TEST(Decimal, ALongOneIsNotTheShortestOfItsDouble) {
  for (const char* text : {"0", "0.000000000000000000000000", "-0.1", "0.10", "1000000", "1e22",
                           "0.30000000000000004", "17976931348623157e292", "4.9e-324", "5e-324"}) {
    const bool is_smallest = std::string_view(text) == "4.9e-324";  // its shortest text is 5e-324
    EXPECT_EQ(is_long_decimal(text), is_smallest) << text;
  }
  for (const char* text :
       {"0.1000000000000000055511151231257827", "0.30000000000000001", "0.500000000000000000",
        "1e-400", "0.99999999999999999999", "9007199254740993"}) {
    EXPECT_TRUE(is_long_decimal(text)) << text;
  }
}

TEST(Decimal, TheShortestIsDigitsTimesAPowerOfTen) {
  EXPECT_EQ(shortest_decimal(0.0), (Decimal{0, 0}));
  EXPECT_EQ(shortest_decimal(0.3), (Decimal{3, -1}));
  EXPECT_EQ(shortest_decimal(1200.0), (Decimal{12, 2}));
  EXPECT_EQ(shortest_decimal(0.1 + 0.2), (Decimal{30000000000000004, -17}));
  EXPECT_EQ(shortest_decimal(5e-324), (Decimal{5, -324}));
  EXPECT_EQ(shortest_decimal(1.7976931348623157e308), (Decimal{17976931348623157, 292}));
}

TEST(Decimal, OneIsAboveAnotherExactly) {
  for (const char* text : {"1.00000000000000000000000001", "2", "1.1e0", "0.11e1", "12e-1", "9e0",
                           "100000000000000000000000001e-26"}) {
    EXPECT_TRUE(is_above(text, "1")) << text;
    EXPECT_FALSE(is_above("1", text)) << text;
  }
  for (const char* text : {"1", "1.000", "0.99999999999999999999999", "0", "0.0", "10e-1", "9e-1",
                           "0.0001e4", "99999999999999999999999999e-26"}) {
    EXPECT_FALSE(is_above(text, "1")) << text;
  }
  EXPECT_TRUE(is_above("100.0000000000000000000001", "1", 2));
  EXPECT_FALSE(is_above("100", "1", 2));
  EXPECT_TRUE(is_above("1", "0"));
  EXPECT_FALSE(is_above("0", "0"));
}

TEST(Decimal, LongTextsAreLongAndReadBack) {
  SeededDraws draws(4401);
  for (int i = 0; i < 2000; ++i) {
    const double value = i == 0 ? 0.5 : std::ldexp(draws.uniform(-1.0, 1.0), i % 200 - 100);
    const std::string text = long_text(value);
    EXPECT_EQ(nearest_double(text), value);
    EXPECT_TRUE(is_long_decimal(text)) << text;
    EXPECT_FALSE(is_long_decimal(shortest_text(value))) << text;
    EXPECT_EQ(text, by_trial::long_text(value));
  }
}

std::vector<double> doubles_of_every_size() {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values = {0.0,
                                -0.0,
                                1.0,
                                0.1,
                                -0.3,
                                1e22,
                                1e23,
                                1e21,
                                1e-7,
                                123456.0,
                                6.02214076e23,
                                Limits::max(),
                                1e5,
                                1e-5,
                                12e20,
                                Limits::min(),
                                Limits::denorm_min()};
  for (int power = -320; power <= 308; ++power) values.push_back(std::pow(10.0, power));
  for (int power = -1074; power <= 1023; ++power) values.push_back(std::ldexp(1.0, power));
  constexpr std::uint64_t seed = 20261126;
  SeededDraws draws(seed);
  for (int i = 0; i < 5'000; ++i) {
    values.push_back(draws.either_sign(1e-300, 1e300));
    values.push_back(std::round(draws.log_uniform(1.0, 1e20)));
    values.push_back(std::round(draws.log_uniform(1.0, 1e4)) / 1000.0);
  }
  return values;
}

TEST(Decimal, WritesTheSameTextWithoutTheStandardLibrary) {
  for (const double value : doubles_of_every_size()) {
    EXPECT_EQ(by_trial::shortest_text(value), shortest_text(value));
    EXPECT_EQ(by_trial::shortest_scientific_text(value), shortest_scientific_text(value));
    EXPECT_EQ(by_trial::rounded_text(value, 4), rounded_text(value, 4));
  }
}

TEST(Decimal, ReadsBackWhatItWrote) {
  for (const double value : doubles_of_every_size()) {
    if (value == 0.0) continue;
    const auto read = nearest_double(by_trial::shortest_text(value));
    ASSERT_TRUE(read) << value;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*read), std::bit_cast<std::uint64_t>(value));
  }
}

}  // namespace
}  // namespace gearlash::decimal_test
