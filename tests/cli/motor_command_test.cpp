// gearlash motor: every line can be recomputed with a pencil. README and
// docs/reference/command-line.md show its steps.
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

TEST(MotorCommand, OfAFieldControlledMotorHasNoStepForBackEmf) {
  EXPECT_THAT(run_tool({"motor", "examples/antenna-field-controlled.toml"}).out,
              HasSubstr("  5. Damping coefficient"));
}

TEST(MotorCommand, ReadsFromAPipeWithTheAuthorsUnits) {
  const Outcome run =
      test::run_shell("cat examples/elinco-fd162.toml | \"$GEARLASH\" motor /dev/stdin");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, run_tool({"motor", "examples/elinco-fd162.toml"}).out);
}

}  // namespace
}  // namespace gearlash::motor_command_test
