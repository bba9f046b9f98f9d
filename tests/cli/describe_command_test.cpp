// gearlash describe as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::describe_command_test {
namespace {

using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> servo = {"--damping",        "0.19", "--inertia-ratio", "2",
                                        "--friction-ratio", "0.1",  "--backlash",      "0.3"};

Outcome describe(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"describe"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

std::vector<std::string> of_servo(std::vector<std::string> more) {
  more.insert(more.begin(), servo.begin(), servo.end());
  return more;
}

/// The first row of the table of docs/explanation/describing-functions.md.
TEST(DescribeCommand, PutsThePredictionBesideTheExactCycle) {
  const Outcome run = describe(of_servo({"--format", "json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_NEAR(json["cycles"][0]["amplitude"], 0.2416, 5e-5);
  EXPECT_NEAR(json["cycles"][0]["period"], 6.456, 5e-4);
  const auto& held = json["analyses"][0]["cycles"][1];
  EXPECT_NEAR(held["amplitude"], 0.2332, 5e-5);
  EXPECT_NEAR(held["balance"]["period"], 7.872, 5e-4);
  EXPECT_NEAR(held["error"]["amplitude"], 0.2332 / 0.2416 - 1.0, 5e-4);
  const auto& coasting = json["analyses"][1]["cycles"][0];
  EXPECT_NEAR(coasting["amplitude"], 0.5715, 5e-5);
  EXPECT_NEAR(coasting["error"]["period"], 5.908 / 6.456 - 1.0, 5e-4);
  EXPECT_EQ(json["units"], "SI");
}

/// What the data sheet says in seconds is what its normalised servo says in 1/ω_n.
TEST(DescribeCommand, ADataSheetIsDescribedInSeconds) {
  const auto json =
      nlohmann::json::parse(describe({"examples/elinco-fd162.toml", "--format", "json"}).out);
  const auto exact = nlohmann::json::parse(
      run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--format", "json"}).out);
  EXPECT_EQ(json["units"], "SI");
  EXPECT_EQ(json["cycles"][0]["period"], exact["cycles"][0]["period"]);
  EXPECT_EQ(json["cycles"][0]["amplitude"], exact["cycles"][0]["amplitude"]);
  const double frequency = exact["normal_form"]["natural_frequency"];
  const double damping = exact["normal_form"]["damping"];
  // K/(J s² + F s), the denominator's lead 1.
  const auto& loop = json["analyses"][0]["loop"];
  EXPECT_NEAR(loop["numerator"][0].get<double>() / (frequency * frequency), 1.0, 1e-14);
  EXPECT_NEAR(loop["denominator"][1].get<double>() / (2.0 * damping * frequency), 1.0, 1e-14);
}

TEST(DescribeCommand, BadInputIsToldAtOnce) {
  const Outcome several = describe(of_servo({"--plot", "phase=a.svg", "--part", "wind"}));
  EXPECT_EQ(several.status, 2);
  EXPECT_EQ(several.err,
            "gearlash: --plot = phase=a.svg: must be nyquist=FILE\n"
            "gearlash: --part = wind: must be gap, elastic-gap, torque-limit, "
            "coulomb-friction, dead-band or relay\n");
  EXPECT_EQ(describe(of_servo({"--part", "gap"})).err,
            "gearlash: --part = gap: must come with --plot: it chooses what to draw\n");
  const Outcome absent = describe(of_servo({"--plot", "nyquist=a.svg", "--part", "torque-limit"}));
  EXPECT_EQ(absent.status, 2);
  EXPECT_THAT(absent.err, HasSubstr("must be a part that the drive has inside its loop"));
  const Outcome massless = describe(
      {"--damping", "0.1", "--inertia-ratio", "inf", "--friction-ratio", "0.5", "--backlash", "0"});
  EXPECT_THAT(massless.err, HasSubstr("motor.inertia = 0 kg m2: must be positive"));
  EXPECT_THAT(massless.err, HasSubstr("backlash = 0 rad: must be positive"));
}

/// A drive's file but for its motor's friction and all that follows.
constexpr char drive_file[] = R"([gearbox]
ratio = 1
backlash = "1 deg"
[load]
inertia = "0.05 kg m2"
friction = "0.02 N m s/rad"
[motor]
kind = "torque-controlled"
inertia = "0.02 kg m2"
)";

/// PD by the motor's encoder, Coulomb friction, a torque limit.
TEST(DescribeCommand, DrivesAreDescribedPartByPart) {
  const Scratch scratch;
  const auto path = scratch / "drive.toml";
  std::ofstream(path) << drive_file << R"(friction = "0.05 N m s/rad"
coulomb = "0.1 N m"
torque_limit = "3 N m"
[sensor]
position = "motor"
[controller]
kind = "PD"
proportional = "20 N m/rad"
derivative = "0.6 N m s/rad"
)";
  const Outcome run = describe({path.string(), "--format", "json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["units"], "SI");
  EXPECT_THAT(json["verdict"].get<std::string>(), HasSubstr("rest"));
  ASSERT_EQ(json["analyses"].size(), 4U);
  EXPECT_EQ(json["analyses"][2]["part"], "torque limit");
  EXPECT_EQ(json["analyses"][2]["nonlinearity"]["limit"], 3.0);
  EXPECT_EQ(json["analyses"][3]["nonlinearity"]["torque"], 0.1);
  EXPECT_THAT(json["analyses"][0]["assumptions"][0].get<std::string>(),
              StartsWith("the sensors are on the motor"));
}

/// No harmonic balance of a loop by itself predicts what a load torque does.
TEST(DescribeCommand, WhatIsDrivenIsNoErrorOfAPrediction) {
  const Scratch scratch;
  const auto path = scratch / "drive.toml";
  std::ofstream(path) << drive_file << R"(friction = "0.5 N m s/rad"
[sensor]
position = "load"
[controller]
kind = "P"
proportional = "20 N m/rad"
[load_torque]
kind = "sine"
amplitude = "1 N m"
frequency = "1 Hz"
)";
  const Outcome text = describe({path.string()});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, StartsWith("forced oscillation: ±3.09 deg"));
  EXPECT_THAT(text.out, testing::Not(HasSubstr("error")));
  const auto json = nlohmann::json::parse(describe({path.string(), "--format", "json"}).out);
  EXPECT_EQ(json["verdict"], "forced");
  EXPECT_TRUE(json["analyses"][0]["cycles"][0]["error"].is_null());
}

}  // namespace
}  // namespace gearlash::describe_command_test
