// Other software in the process may have changed how a thread rounds: then nothing is proved there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <filesystem>
#include <string>

#include "closed_form/cycle_bounds.hpp"
#include "closed_form/energy_balance.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/input.hpp"

namespace gearlash::changed_arithmetic_test {
namespace {

Answer answer_rounding(int mode, const Drive& drive) {
  const int before = std::fegetround();
  std::fesetround(mode);
  Answer answer = analyse(drive, {.proofs = true, .ceiling = true});
  std::fesetround(before);
  return answer;
}

bool says_why(const Answer& answer) {
  return std::any_of(answer.notes.begin(), answer.notes.end(), [](const Note& note) {
    return note.code == "arithmetic" &&
           note.text == "Nothing is proved: this thread does not round to the nearest number.";
  });
}

/// Enclosed with the usual rounding; with another one the same cycle is computed.
TEST(ChangedArithmetic, EnclosesNoCycleOfAServo) {
  const Drive servo = normal_form(0.19, 2.0, 0.1, 0.3);
  const Answer usual = answer_rounding(FE_TONEAREST, servo);
  EXPECT_GE(usual.certainty, Certainty::enclosed);
  EXPECT_FALSE(says_why(usual));
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const Answer answer = answer_rounding(mode, servo);
    EXPECT_LT(answer.certainty, Certainty::enclosed);
    EXPECT_TRUE(says_why(answer));
    EXPECT_FALSE(answer.ceiling && answer.ceiling->load);
    EXPECT_FALSE(answer.ceiling && answer.ceiling->mesh_torque);
  }
}

/// Exact comparisons decide it, of data that were read by that arithmetic.
TEST(ChangedArithmetic, TellsNoTheorem) {
  for (const Drive& servo : {normal_form(1.0, 1.0, 0.5, 0.3), normal_form(0.3, 1.0, 1.0, 0.3),
                             normal_form(0.0, 1.0, 0.5, 0.3), normal_form(0.3, 1.0, 0.5, 0.0)}) {
    EXPECT_EQ(answer_rounding(FE_TONEAREST, servo).certainty, Certainty::theorem);
    const Answer answer = answer_rounding(FE_UPWARD, servo);
    EXPECT_LT(answer.certainty, Certainty::enclosed);
    EXPECT_LT(answer.completeness, Certainty::enclosed);
    for (const Cycle& cycle : answer.cycles) EXPECT_LT(cycle.certainty, Certainty::enclosed);
    EXPECT_FALSE(answer.bounds);
    EXPECT_TRUE(says_why(answer));
  }
}

TEST(ChangedArithmetic, EnclosesNoBoxByEnergy) {
  const ServoBox box = box_of({.damping = 2.0, .friction_ratio = 0.5}, Reading::exact);
  EXPECT_TRUE(is_dissipative(box));
  const int before = std::fegetround();
  std::fesetround(FE_DOWNWARD);
  const bool is_proved = is_dissipative(box);
  std::fesetround(before);
  EXPECT_FALSE(is_proved);
}

TEST(ChangedArithmetic, ProvesNoAbsenceByEnergy) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0, .friction = {.viscous = 2.0}};
  drive.load = {.inertia = 1.0, .friction = {.viscous = 2.0}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.sensor.position = SensorPlace::motor;
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 1.0,
                             .integral = 0.05,
                             .derivative = 1.0,
                             .filter = 0.05};
  EXPECT_EQ(answer_rounding(FE_TONEAREST, drive).verdict, Verdict::cannot_hunt);
  const Answer answer = answer_rounding(FE_UPWARD, drive);
  EXPECT_NE(answer.verdict, Verdict::cannot_hunt);
  EXPECT_TRUE(says_why(answer));
}

}  // namespace
}  // namespace gearlash::changed_arithmetic_test
