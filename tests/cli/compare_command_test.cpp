// compare answers on both sides of the gap, with it and without it.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::compare_command_test {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_tool;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> with_arguments(std::vector<std::string> first,
                                        const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// Every sensor has a verdict, from decided starts alone, and a step response to its end.
void expect_answers(const json& printed, const std::vector<std::string>& sensors) {
  ASSERT_EQ(printed["cases"].size(), sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    SCOPED_TRACE(sensors[i]);
    const json& one = printed["cases"][i];
    EXPECT_EQ(one["sensor"], sensors[i]);
    EXPECT_NE(one["limit_cycle"]["verdict"], "undecided");
    ASSERT_FALSE(one["limit_cycle"]["search"].is_null());
    EXPECT_FALSE(one["limit_cycle"]["search"]["starts"].empty());
    for (const json& start : one["limit_cycle"]["search"]["starts"]) {
      EXPECT_NE(start["end"], "undecided") << start;
    }
    const json& response = one["step_response"];
    EXPECT_GT(response["watched"].get<double>(), 0.0);
    EXPECT_TRUE(response["final_error"].is_number());
    EXPECT_TRUE(response["ripple"].is_number());
    EXPECT_TRUE(response["overshoot"].is_number());
  }
}

/// Of a joint whose registers are a firmware's.
TEST(CompareCommand, AnswersBeforeAndAfterTheGap) {
  const std::vector<std::string> command = {"compare", "examples/dynamixel-joint.toml", "--sensor",
                                            "load,motor,both"};
  const Outcome text = run_tool(command);
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, Not(HasSubstr("undecided")));
  EXPECT_THAT(text.out, Not(HasSubstr("not known")));
  EXPECT_THAT(text.out, Not(HasSubstr("could be followed only")));
  const Outcome run = run_tool(with_arguments(command, {"--format", "json"}));
  EXPECT_EQ(run.status, 0) << run.err;
  expect_answers(json::parse(run.out), {"load", "motor", "both"});
}

/// Behind the gap the axis hunts; before it, the motor stands at the reference and the load
/// anywhere in the gap.
TEST(CompareCommand, ThatTheEncoderOnTheMotorEndsTheHuntingOfTheAxis) {
  const json printed = json::parse(run_tool({"compare", "examples/telescope-axis.toml", "--sensor",
                                             "load,motor", "--format", "json"})
                                       .out);
  EXPECT_EQ(printed["cases"][0]["limit_cycle"]["verdict"], "hunts");
  EXPECT_EQ(printed["cases"][1]["limit_cycle"]["verdict"], "comes to rest");
  const double half_gap = 5.0 / 60.0 * std::acos(-1.0) / 180.0;
  const json& error = printed["cases"][1]["limit_cycle"]["rest"]["error"];
  EXPECT_NEAR(error[1].get<double>(), half_gap, 1e-3 * half_gap);
  EXPECT_EQ(error[0].get<double>(), -error[1].get<double>());
  // A step leaves it on one of the faces.
  EXPECT_NEAR(printed["cases"][1]["step_response"]["final_error"].get<double>(), half_gap,
              1e-3 * half_gap);
  EXPECT_NEAR(printed["cases"][0]["step_response"]["final_error"].get<double>(), 0.0,
              1e-6 * half_gap);
}

/// The same axis with faces that give way: without a gap it is a drive with joined shafts.
TEST(CompareCommand, AnswersWithTheGapAndWithoutIt) {
  const auto compared = [](const std::string& backlash) {
    const Outcome run =
        run_tool({"compare", "examples/telescope-axis.toml", "--sensor", "load,motor,both",
                  "--step", "10 arcmin", "--set", "contact.stiffness=44 N m/arcmin", "--set",
                  "contact.damping=80 N m s/rad", "--set", "gearbox.backlash=" + backlash,
                  "--format", "json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
  };
  const json with = compared("10 arcmin");
  const json without = compared("0");
  expect_answers(with, {"load", "motor", "both"});
  expect_answers(without, {"load", "motor", "both"});
  EXPECT_EQ(with["cases"][0]["limit_cycle"]["verdict"], "hunts");
  for (const json& one : without["cases"]) {
    EXPECT_EQ(one["limit_cycle"]["verdict"], "comes to rest") << one["sensor"];
    EXPECT_TRUE(one["step_response"]["settling_time"].is_number()) << one["sensor"];
  }
}

}  // namespace
}  // namespace gearlash::compare_command_test
