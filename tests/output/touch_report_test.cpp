// What a simulation's tables say where rounding decides whether an event happens.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "output/drive_motion_report.hpp"
#include "output/motion_report.hpp"

namespace gearlash {
namespace {

using testing::HasSubstr;
using testing::Not;

template <class Write>
std::string written(const Write& write) {
  std::string text;
  write([&](std::string_view part) { text += part; });
  return text;
}

/// Without friction and with the load at rest u = t − t² (J_M = ½): it turns at ¼.
MotionReport servo_report(double backlash) {
  MotionReport report{
      .servo = {.damping = 0.0, .inertia_ratio = 1.0, .friction_ratio = 0.0, .backlash = backlash},
      .initial = {.motor_position = 1.0, .load_position = 1.0},
      .until = 0.75,
      .every = 0.25};
  report.initial.set_gap_speed(1.0);
  report.trajectory =
      simulate(report.servo, report.initial, {.until = report.until, .reference = 0.0});
  return report;
}

TEST(TouchReport, OfAServoIsALineAndAList) {
  const MotionReport grazes = servo_report(0.5);
  const std::string text = written([&](const TextSink& sink) { write_events_csv(grazes, sink); });
  EXPECT_THAT(text, HasSubstr("\n# touches = 1, first at 0."));
  EXPECT_THAT(text, HasSubstr(" (forward): rounding decides whether the faces meet there\n"));
  const auto json = nlohmann::json::parse(
      written([&](const TextSink& sink) { write_motion_json(grazes, sink, [](double) {}); }));
  ASSERT_EQ(json["touches"].size(), 1U);
  EXPECT_NEAR(json["touches"][0]["time"].get<double>(), 0.5, 1e-7);
  EXPECT_EQ(json["touches"][0]["face"], "forward");
}

TEST(TouchReport, OfAServoIsMissingWhereNothingIsInDoubt) {
  const MotionReport clear = servo_report(0.5 + 1e-12);
  EXPECT_THAT(written([&](const TextSink& sink) { write_events_csv(clear, sink); }),
              Not(HasSubstr("# touches")));
}

/// x = (t − 1)² + a height, of a system that stands for a drive's.
DriveMotionReport drive_report(double height) {
  const hybrid::Vector start{{1.0, -2.0, 0.0, 0.0}};
  hybrid::Matrix flow = hybrid::Matrix::Zero(4, 4);
  flow(0, 1) = 1.0;
  const hybrid::Transition floor{.name = "faces meet forward",
                                 .guard = {hybrid::Vector{{1.0, 0.0, 0.0, 0.0}}, height}};
  DriveMotionReport report{};
  report.system.system = {
      .state_names = {"motor position", "motor speed", "load position", "load speed"},
      .modes = {{.name = "apart",
                 .flow = {flow, hybrid::Vector{{0.0, 2.0, 0.0, 0.0}}},
                 .transitions = {floor}}}};
  report.until = 3.0;
  report.trajectory = hybrid::simulate(report.system.system, {0, start}, {.until = report.until});
  return report;
}

TEST(TouchReport, OfADriveIsALineThatNamesTheEvent) {
  const std::string text =
      written([&](const TextSink& sink) { write_events_csv(drive_report(0.0), sink); });
  EXPECT_THAT(text,
              HasSubstr("\n# touches = 1, first at 1 (faces meet forward): rounding decides"));
  EXPECT_THAT(written([&](const TextSink& sink) { write_events_csv(drive_report(1e-9), sink); }),
              Not(HasSubstr("# touches")));
}

}  // namespace
}  // namespace gearlash
