// Values with tolerances, by themselves.
#include "input/toleranced_value.hpp"

#include <gtest/gtest.h>

namespace gearlash::toleranced_value_test {
namespace {

TolerancedValue read(const std::string& toml) {
  const toml::table table = toml::parse("x = " + toml);
  return read_toleranced("x", *table.get("x"),
                         [](const std::string& field, const toml::node& node) -> Measured {
                           const auto text = node.value_exact<std::string>();
                           return {.si = text ? read_number(field, *text) : *node.value<double>()};
                         });
}

TEST(TolerancedValue, APercentageIsOfTheSizeOfTheValue) {
  for (const char* text : {"'2 ± 10 %'", "'-2 ± 10 %'"}) {
    const TolerancedValue value = read(text);
    ASSERT_TRUE(value.distribution) << text;
    EXPECT_DOUBLE_EQ(std::get<UniformAbout>(*value.distribution).tolerance, 0.2) << text;
  }
}

TEST(TolerancedValue, NominalIsTheFirstOfTheHeaviestLots) {
  EXPECT_EQ(
      read("{ lots = [1, { value = 2, weight = 3 }, { value = 3, weight = 3 }, 4] }").nominal.si,
      2.0);
}

}  // namespace
}  // namespace gearlash::toleranced_value_test
