// Text and JSON of a comparison, from the same record.
#include "output/comparison_report.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace gearlash::comparison_report_test {
namespace {

using nlohmann::json;
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

TEST(ComparisonReport, JsonIsOfTheSameRecordInSI) {
  const json printed = json::parse(comparison_json(report()));
  EXPECT_EQ(printed["schema"], "gearlash/compare/3");
  EXPECT_TRUE(printed["axis"].is_null());
  const json& cases = printed["drives"];
  const json& values = cases[0]["answer"]["values"];
  EXPECT_EQ(values["motor_amplitude"], 0.5 * degree);
  EXPECT_EQ(values["frequency"], 2.0);
  EXPECT_EQ(values["phase_margin"], 60.0 * degree);
  EXPECT_EQ(values["overshoot"], 0.25);
  EXPECT_EQ(cases[0]["answer"]["verdict"], "hunts");
  EXPECT_EQ(cases[1]["answer"]["loop"]["is_stable"], false);
  EXPECT_TRUE(cases[1]["answer"]["step"].is_null());
  EXPECT_EQ(cases[2]["name"], "third");
  for (const std::string key : {"stiffness", "answer"}) {
    EXPECT_TRUE(cases[2][key].is_null()) << key;
  }
}

}  // namespace
}  // namespace gearlash::comparison_report_test
