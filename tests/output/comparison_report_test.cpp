// The text of a comparison.
#include "output/comparison_report.hpp"

#include <gmock/gmock.h>

namespace gearlash::comparison_report_test {
namespace {

using testing::HasSubstr;

constexpr double degree = 0.017453292519943295;

/// A motor that ticks within the gap, an answer that is not whole, and a drive that was not
/// reached.
ComparisonReport report() {
  const Drive drive = normal_form(0.2, 1.0, 0.5, 0.1);
  Answer ticks;
  ticks.verdict = Verdict::hunts;
  ticks.cycles = {{.amplitude = 1e-12, .motor_amplitude = 0.5 * degree, .period = 0.5}};
  ticks.loop = LinearLoop{.is_stable = true, .phase_margin = 60.0 * degree};
  ticks.step = StepResponse{.step = degree, .until = 1.0, .overshoot = 0.25, .is_whole = false};
  Answer unstable;
  unstable.verdict = Verdict::runs_away;
  unstable.loop = LinearLoop{};
  ComparisonReport made;
  made.drives = {{.name = "first", .drive = drive, .answer = ticks, .stiffness = 2.0},
                 {.name = "second", .drive = drive, .answer = unstable, .encoder_step = degree},
                 {.name = "third", .drive = drive}};
  made.drives[0].drive.servo->natural_frequency = 3.0;
  made.drives[0].drive.angle_unit = {"deg", degree};
  made.quantities = {Quantity::motor_amplitude, Quantity::frequency, Quantity::phase_margin,
                     Quantity::overshoot};
  return made;
}

TEST(ComparisonReport, TextHasUnitsWhatIsUnknownAndWhatToKnow) {
  EXPECT_EQ(comparison_text(report()),
            R"(  first   hunts: the motor within the gap, ±0.5 deg at 2 Hz, while the load stands
  second  runs away
  third   not reached

  drive                           first     second      third
  certainty                       searched  searched    –
  loop without the gap            stable    not stable  –
  loop stiffness (N m/rad)        2         –           –
  encoder step at the load (deg)  0         1           –
  motor amplitude (deg)           0.5       –           –
  frequency (Hz)                  2         –           –
  phase margin (deg)              60        –           –
  overshoot (%)                   25        –           –

Not stable even without the gap: second. What happens there is not due to backlash alone,
and a step response is left out. All make a step of 1 deg, settled within ±0 deg; it is less
than the gap of first: --step gives another; it could not be followed to its end: first.
)");
}

}  // namespace
}  // namespace gearlash::comparison_report_test
