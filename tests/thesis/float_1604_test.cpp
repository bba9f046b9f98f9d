// Words and arithmetic of the CDC 1604's floating point.
#include "thesis/float_1604.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "base/seeded_draws.hpp"
#include "thesis/listing.hpp"

namespace gearlash::thesis::float_1604_test {
namespace {

TEST(OracleFloat1604, ConstantsOfTheListingHaveItsWords) {
  // Every DEC with a point in Table I, by way of the assembler.
  const Assembly assembly = assemble(thesis_table_1().program);
  int constants = 0;
  for (const auto& [address, source] : assembly.sources) {
    if (!source.starts_with("DEC") || source.find('.') == std::string::npos) continue;
    ++constants;
    EXPECT_EQ(octal_text(assembly.words.at(address)),
              octal_text(thesis_table_1().octal.at(address)))
        << source;
    const double value = std::stod(source.substr(4));
    EXPECT_NEAR(Float1604::of(assembly.words.at(address)).value(), value, value * 0x1p-35);
  }
  EXPECT_EQ(constants, 56);
}

TEST(OracleFloat1604, WordsOfTheMachinesDescription) {
  EXPECT_EQ(Float1604::truncated(-0.5).word(), 05777377777777777U);
  EXPECT_EQ(Float1604::truncated(-1.0).word(), 05776377777777777U);
  EXPECT_EQ(Float1604::truncated(0.5).word(), 02000400000000000U);
  EXPECT_EQ(Float1604::truncated(0.25).word(), 01776400000000000U);  // 1777 is never used
  EXPECT_EQ(Float1604::truncated(2.0).word(), 02002400000000000U);
  EXPECT_EQ(Float1604().word(), 0U);
  EXPECT_TRUE(Float1604::of(word_bits).is_zero());  // minus zero
}

TEST(PropertyFloat1604, WordsAndValuesReadBack) {
  constexpr std::uint64_t seed = 1604;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 20000; ++i) {
    const double value = draws.either_sign(1e-200, 1e200);
    const Float1604 number = Float1604::truncated(value);
    EXPECT_LE(std::abs(number.value()), std::abs(value));
    EXPECT_GT(std::abs(number.value()), std::abs(value) * (1.0 - 0x1p-35));
    ASSERT_EQ(Float1604::of(number.word()), number);
    ASSERT_EQ((-number).word(), complement(number.word()));
  }
}

TEST(PropertyFloat1604, OrderOfFloatsIsThatOfTheirWords) {
  SeededDraws draws(1605);
  for (int i = 0; i < 5000; ++i) {
    const Float1604 one = Float1604::truncated(draws.log_uniform(1e-30, 1e30));
    const Float1604 other = Float1604::truncated(draws.log_uniform(1e-30, 1e30));
    ASSERT_EQ(one.value() < other.value(), one.word() < other.word());
  }
}

TEST(PropertyFloat1604, ResultsAreWithinAUnitAndExactWhereTheyCanBe) {
  SeededDraws draws(1606);
  for (int i = 0; i < 20000; ++i) {
    const Float1604 a = Float1604::truncated(draws.either_sign(1e-6, 1e6));
    const Float1604 b = Float1604::truncated(draws.either_sign(1e-6, 1e6));
    const double larger = std::max(std::abs(a.value()), std::abs(b.value()));
    for (const SumRule rule :
         {SumRule::no_guard_digits, SumRule::exact_truncated, SumRule::exact_rounded}) {
      ASSERT_NEAR(sum(a, b, rule).value(), a.value() + b.value(), 2.0 * larger * 0x1p-35);
      ASSERT_TRUE(sum(a, -a, rule).is_zero());
      ASSERT_EQ(sum(a, Float1604(), rule), a);
    }
    const double exact_product = a.value() * b.value();
    const Float1604 cut = product(a, b, LengthRule::truncated);
    ASSERT_LE(std::abs(cut.value()), std::abs(exact_product) * (1.0 + 0x1p-52));
    ASSERT_NEAR(cut.value(), exact_product, std::abs(exact_product) * 0x1p-35);
    ASSERT_NEAR(product(a, b, LengthRule::rounded).value(), exact_product,
                std::abs(exact_product) * 0x1p-36 * (1.0 + 1e-9));
    ASSERT_NEAR(quotient(a, b, LengthRule::rounded).value(), a.value() / b.value(),
                std::abs(a.value() / b.value()) * 0x1p-36 * (1.0 + 1e-3));
    ASSERT_EQ(product(a, Float1604::truncated(2.0), LengthRule::truncated).value(),
              2.0 * a.value());
  }
}

TEST(EdgeFloat1604, SumsWithoutGuardDigitsLoseWhatIsShiftedOut) {
  const Float1604 one = Float1604::truncated(1.0);
  const Float1604 little = Float1604::truncated(-0x1p-40);
  EXPECT_EQ(sum(one, little, SumRule::no_guard_digits), one);
  EXPECT_EQ(sum(one, little, SumRule::exact_truncated).value(), 1.0 - 0x1p-36);
  EXPECT_EQ(sum(one, little, SumRule::exact_rounded), one);
  const Float1604 last_bit = Float1604::truncated(-0x1p-36);
  EXPECT_EQ(sum(one, last_bit, SumRule::no_guard_digits), one);
  EXPECT_EQ(sum(one, last_bit, SumRule::exact_rounded).value(), 1.0 - 0x1p-36);
}

TEST(EdgeFloat1604, FaultsAndUnderflow) {
  const Float1604 large = Float1604::truncated(0x1p1000);
  EXPECT_THROW(product(large, large, LengthRule::truncated), std::overflow_error);
  EXPECT_THROW(quotient(large, Float1604(), LengthRule::truncated), std::domain_error);
  EXPECT_THROW(Float1604::truncated(INFINITY), std::overflow_error);
  const Float1604 small = Float1604::truncated(0x1p-1000);
  EXPECT_TRUE(product(small, small, LengthRule::truncated).is_zero());
}

}  // namespace
}  // namespace gearlash::thesis::float_1604_test
