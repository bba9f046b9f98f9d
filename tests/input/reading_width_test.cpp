// What reading a decimal with its unit rounds, against 60 digits.
#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/number.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/units.hpp"
#include "input/unit_expression.hpp"

namespace gearlash::reading_width_test {
namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                             boost::multiprecision::et_off>;

/// What is measured with a unit of its own, and what makes another quantity of it.
struct Kind {
  const char* completed;  ///< follows the unit
  const Dimension* dimension;
};
const Kind mass{" m2", &dimensions::inertia};
const Kind force{" m", &dimensions::torque};
const Kind angle{"", &dimensions::angle};
const Kind speed{"", &dimensions::angular_speed};
const Kind work{"", &dimensions::torque};
const Kind moment{" m", &dimensions::inertia};  ///< kg m
const Kind torque_time{"", &dimensions::torque_per_speed};
const Kind volt_time{"", &dimensions::voltage_per_speed};

struct ExactUnit {
  Digits factor;
  Kind kind;
};

/// By the definitions of the units: of their standards, not of the table.
std::map<std::string, ExactUnit> exact_units() {
  const Digits turn = boost::math::constants::two_pi<Digits>();
  const Digits degree = turn / 360;
  const Digits pound("0.45359237");
  const Digits gravity("9.80665");
  const Digits inch("0.0254");
  const Digits foot = 12 * inch;
  const Digits ounce = pound / 16;
  const Digits gram("0.001");
  std::map<std::string, ExactUnit> units;
  const auto add = [&](const Digits& factor, const Kind& kind,
                       const std::vector<const char*>& words) {
    for (const char* word : words) units[word] = {factor, kind};
  };
  add(ounce, mass, {"avoirdupois_ounce", "oz", "ounce", "ounces"});
  add(ounce * gravity, force, {"ounce_force", "ounces_force", "force_ounce", "ozf"});
  add(pound, mass, {"lbs", "lbm"});
  add(pound * gravity / foot, mass, {"slug", "slugs"});
  add(gravity, force, {"kp"});
  add(Digits("1e-5"), force, {"dyn"});
  add(degree, angle, {"deg", "degs"});
  add(degree / 60, angle, {"MOA", "moa"});
  add(degree * Digits("0.9"), angle, {"gon", "gons"});
  add(turn, angle, {"rev", "revs"});
  add(turn / 60, speed, {"rpm"});
  add(turn, speed, {"Hz", "hertz"});
  add(1, work, {"Nm"});
  add(Digits("0.01"), work, {"Ncm"});
  add(gram, work, {"Nmm"});
  add(1, torque_time, {"Nms"});
  add(1, volt_time, {"Vs"});
  add(1, moment, {"kgm"});
  add(gram / 100, moment, {"gcm"});
  add(gram / 1000, moment, {"gmm"});
  add(gram * gravity / 100, work, {"gfcm"});
  add(gravity, work, {"kgfm"});
  add(ounce * inch, moment, {"ozin", "inoz"});
  add(ounce * gravity * inch, work, {"ozfin", "inozf"});
  add(pound * inch, moment, {"lbin", "inlb"});
  add(pound * foot, moment, {"lbft", "ftlb"});
  add(pound * gravity * inch, work, {"lbfin", "inlbf"});
  add(pound * gravity * foot, work, {"lbfft", "ftlbf"});
  for (const auto& [prefix, power] : std::map<std::string, int>{
           {"", 0},    {"Y", 24},  {"Z", 21},  {"E", 18}, {"P", 15}, {"T", 12},
           {"G", 9},   {"M", 6},   {"k", 3},   {"h", 2},  {"da", 1}, {"d", -1},
           {"c", -2},  {"m", -3},  {"u", -6},  {"µ", -6}, {"n", -9}, {"p", -12},
           {"f", -15}, {"a", -18}, {"z", -21}, {"y", -24}}) {
    add(pow(Digits(10), power), force, {(prefix + "N").c_str()});
  }
  return units;
}

std::string drawn_decimal(SeededDraws& draws) {
  std::string digits(1, static_cast<char>('1' + static_cast<int>(draws.uniform(0.0, 9.0))));
  const int count = static_cast<int>(draws.uniform(0.0, 25.0));
  for (int i = 0; i < count; ++i) {
    if (i == 0) digits += '.';
    digits += static_cast<char>('0' + static_cast<int>(draws.uniform(0.0, 10.0)));
  }
  return digits + "e" + std::to_string(static_cast<int>(draws.uniform(-20.0, 20.0)));
}

void expect_within_width(const std::string& number, const std::string& unit, const Digits& factor,
                         const Dimension& dimension) {
  const double read = to_si("a", number + " " + unit, dimension);
  const Digits exact = Digits(number) * factor;
  const Interval written = AsWritten()(read);
  EXPECT_TRUE(Digits(written.low) <= exact && exact <= Digits(written.high))
      << number << ' ' << unit;
}

TEST(PropertyReadingWidth, ContainsTheDecimalTimesTheUnit) {
  constexpr std::uint64_t seed = 4402;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (const auto& [word, unit] : exact_units()) {
    for (int i = 0; i < 100; ++i) {
      const std::string text = drawn_decimal(draws);
      expect_within_width(text, word + unit.kind.completed, unit.factor, *unit.kind.dimension);
    }
  }
}

TEST(ReadingWidth, NoUnitOfEngineersIsLeftOut) {
  const auto known = exact_units();
  std::ifstream file(GEARLASH_SOURCE_DIRECTORY "/src/input/units_of_engineers.txt");
  std::size_t found = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    std::string name;
    words >> kind >> name;
    if (kind != "unit" && kind != "together") continue;
    ++found;
    EXPECT_TRUE(known.count(name) == 1) << name;
  }
  EXPECT_GT(found, 30U);
}

TEST(ReadingWidth, CountsTheRoundingsOfAProduct) {
  EXPECT_EQ(read_unit("N m/(rad/s)").roundings, 0);
  EXPECT_LE(read_unit("mN m/krpm").roundings, 30);
  EXPECT_LE(read_unit("oz in2").roundings, 30);
  // in⁹/in⁸: many products whose sizes cancel.
  EXPECT_THROW(read_unit("in^9/in^8"), NotAUnit);
  EXPECT_THROW(to_si("a", "1 kg m in^9/in^8", dimensions::inertia), InvalidInput);
}

}  // namespace
}  // namespace gearlash::reading_width_test
