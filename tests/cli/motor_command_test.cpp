// gearlash motor: every line can be recomputed with a pencil.
#include <gmock/gmock.h>

#include <cmath>

#include "tool.hpp"

namespace gearlash::motor_command_test {
namespace {

using test::lines_of;
using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

/// A reader with a pencil: numbers, + × / √ ² and brackets, as the procedure prints them.
class Pencil {
 public:
  explicit Pencil(std::string text) : text_(std::move(text)) {}

  double result() {
    const double value = sum();
    EXPECT_EQ(place_, text_.size()) << "cannot read: " << text_;
    return value;
  }

 private:
  bool takes(const std::string& sign) {
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    if (text_.compare(place_, sign.size(), sign) != 0) return false;
    place_ += sign.size();
    while (place_ < text_.size() && text_[place_] == ' ') ++place_;
    return true;
  }
  double sum() {
    double value = product();
    while (takes("+")) value += product();
    return value;
  }
  double product() {
    double value = factor();
    while (true) {
      if (takes("×")) {
        value *= factor();
      } else if (takes("/")) {
        value /= factor();
      } else {
        return value;
      }
    }
  }
  double factor() {
    const bool is_root = takes("√");
    double value = 0.0;
    if (takes("(")) {
      value = sum();
      EXPECT_TRUE(takes(")")) << text_;
    } else {
      char* end = nullptr;
      value = std::strtod(text_.c_str() + place_, &end);
      place_ = static_cast<std::size_t>(end - text_.c_str());
    }
    if (takes("²")) value *= value;
    return is_root ? std::sqrt(value) : value;
  }

  std::string text_;
  std::size_t place_ = 0;
};

/// The part of a line between its last two equals signs, and what follows.
struct Calculation {
  std::string numbers;
  double result;
};

bool is_calculation(const std::string& line, Calculation& calculation) {
  const std::size_t last = line.rfind(" = ");
  if (last == std::string::npos || last == 0) return false;
  const std::size_t first = line.rfind("= ", last - 1);
  const std::string numbers = line.substr(first == std::string::npos ? 0 : first + 2,
                                          last - (first == std::string::npos ? 0 : first + 2));
  if (numbers.find("×") == std::string::npos && numbers.find('/') == std::string::npos)
    return false;
  if (numbers.find_first_of("JKFTP") != std::string::npos) return false;
  calculation = {numbers, std::strtod(line.c_str() + last + 3, nullptr)};
  return true;
}

class MotorProcedure : public testing::TestWithParam<const char*> {};

TEST_P(MotorProcedure, EveryLineCanBeRecomputedFromItsNumbers) {
  const Outcome run = run_tool({"motor", GetParam()});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string steps = run.out.substr(run.out.find("\nSteps\n"));
  int count = 0;
  for (const std::string& line : lines_of(steps)) {
    Calculation calculation{};
    if (!is_calculation(line, calculation)) continue;
    ++count;
    // Six digits are printed of up to six numbers; a difference of half a unit in each adds up.
    EXPECT_NEAR(Pencil(calculation.numbers).result(), calculation.result, 1e-5 * calculation.result)
        << line;
  }
  EXPECT_GE(count, 7) << steps;
}

INSTANTIATE_TEST_SUITE_P(ThreeMotors, MotorProcedure,
                         testing::Values("examples/elinco-fd162.toml",
                                         "examples/antenna-field-controlled.toml",
                                         "examples/instrument-two-phase.toml"));

/// The number that stands after `before` in the text.
double number_after(const std::string& text, const std::string& before) {
  const std::size_t place = text.find(before);
  EXPECT_NE(place, std::string::npos) << before;
  return std::strtod(text.c_str() + place + before.size(), nullptr);
}

TEST(MotorCommand, ReachesTheNumbersOfAppendixB) {
  const std::string text = run_tool({"motor", "examples/elinco-fd162.toml"}).out;
  constexpr double pound_foot = 1.3558179483314004;  // N m
  constexpr double slug_square_foot = pound_foot;    // kg m2: slug = lbf s2/ft
  EXPECT_NEAR(number_after(text, "10 × 1/282 = ") / pound_foot, 0.0052, 5e-5);
  EXPECT_NEAR(number_after(text, "× 1² = ") / slug_square_foot, 8.2e-6, 5e-8);
  EXPECT_NEAR(number_after(text, "e-05)) = "), 14.5, 0.05);
  EXPECT_NEAR(number_after(text, "4.51939e-06 × 1² = ") / pound_foot, 13.7e-6, 1e-7);
  EXPECT_NEAR(number_after(text, "0.233 × 1²/282 = ") / pound_foot, 121e-6, 0.5e-6);
  EXPECT_NEAR(number_after(text, "1/(2 × 14.5421) = "), 0.19, 0.005);
  EXPECT_NEAR(number_after(text, "2.22354e-05/1.11569e-05 = "), 2.0, 0.05);
  EXPECT_NEAR(number_after(text, "0.000164534) = "), 0.077, 5e-4);
  EXPECT_NEAR(number_after(text, "× 0.1/0.3 = "), 0.083, 0.002);  // read from a chart there
}

TEST(MotorCommand, ShowsEveryConversionBesideWhatTheAuthorWrote) {
  const std::string text = run_tool({"motor", "examples/elinco-fd162.toml"}).out;
  EXPECT_THAT(text, HasSubstr("K_1 = 28.2 ozf in/A          = 0.199136 N m/A\n"));
  EXPECT_THAT(text, HasSubstr("J_m = 0.61 oz in2            = 1.11569e-05 kg m2\n"));
  EXPECT_THAT(text, HasSubstr("J_L = 16.4e-6 slug ft2       = 2.22354e-05 kg m2\n"));
}

TEST(MotorCommand, StepsAreNumberedAsInTheThesis) {
  const std::string armature = run_tool({"motor", "examples/elinco-fd162.toml"}).out;
  EXPECT_THAT(armature, HasSubstr("  6. Damping coefficient"));
  EXPECT_THAT(armature, HasSubstr(" 10. Limit cycle for this backlash"));
  const std::string field = run_tool({"motor", "examples/antenna-field-controlled.toml"}).out;
  EXPECT_THAT(field, HasSubstr("  5. Damping coefficient"));
  const std::string two_phase = run_tool({"motor", "examples/instrument-two-phase.toml"}).out;
  EXPECT_THAT(two_phase, HasSubstr("  5. Friction by the slope"));
  EXPECT_THAT(two_phase, HasSubstr("  6. Damping coefficient"));
}

TEST(MotorCommand, ReadsFromAPipeWithoutTheAuthorsWords) {
  const Outcome run =
      test::run_shell("cat examples/elinco-fd162.toml | \"$GEARLASH\" motor /dev/stdin");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("K_1 = 0.199136 N m/A\n"));
}

}  // namespace
}  // namespace gearlash::motor_command_test
