// gearlash map as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"
#include "tool.hpp"

namespace gearlash::map_command_test {
namespace {

using test::file_text;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A map of damping over friction ratio, with an output and what else is asked for.
std::vector<std::string> map_into(const std::filesystem::path& file,
                                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"map",
                                        "--x",
                                        "friction-ratio=0.05:0.95:13",
                                        "--y",
                                        "damping=0.1:0.8:9:log",
                                        "--inertia-ratio",
                                        "2",
                                        "--output",
                                        file.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(MapCommand, PointsAreSingleCallsAndTheBoundaryIsWhereGrowthIsOne) {
  const Scratch scratch;
  const Outcome run = run_tool(map_into(scratch / "map.json", {"--backlash", "0.3"}));
  EXPECT_EQ(run.status, 0) << run.err;
  const auto map = nlohmann::json::parse(file_text(scratch / "map.json"));
  EXPECT_EQ(map["axes"][0]["path"], "servo.damping");
  EXPECT_EQ(map["axes"][1]["path"], "servo.friction_ratio");
  ASSERT_EQ(map["columns"]["amplitude"].size(), 9U * 13U);
  const NormalizedServo servo{.damping = map["axes"][0]["values"][2],
                              .inertia_ratio = 2.0,
                              .friction_ratio = map["axes"][1]["values"][5],
                              .backlash = 0.3};
  const double amplitude = map["columns"]["amplitude"][2 * 13 + 5];
  EXPECT_NEAR(amplitude, analyse_limit_cycles(servo).cycles.at(0).amplitude, 1e-12 * amplitude);
  ASSERT_EQ(map["hunting_boundary"].size(), 1U);
  ASSERT_GT(map["hunting_boundary"][0].size(), 20U);
  for (const auto& point : map["hunting_boundary"][0]) {
    NormalizedServo there = servo;
    there.friction_ratio = point["x"];
    there.damping = point["y"];
    EXPECT_NEAR(growth_at_rest(servo_dynamics(there)), 1.0, 1e-13);
  }
}

TEST(MapCommand, TheRegionOfAnyRestitutionIsTheEnergys) {
  const Scratch scratch;
  ASSERT_EQ(run_tool(map_into(scratch / "map.json", {"--proved"})).status, 0);
  const auto map = nlohmann::json::parse(file_text(scratch / "map.json"));
  EXPECT_EQ(map["certainty"], "enclosed");
  ASSERT_EQ(map["dissipative_boundary"].size(), 1U);
  ASSERT_GT(map["dissipative_boundary"][0].size(), 10U);
  for (const auto& point : map["dissipative_boundary"][0]) {
    const double friction = point["x"];
    const double damping = point["y"];
    // 1/c + 1/D = 2ζ with J_L/J_M = 2; at the edge of the map a corner may stand for it.
    const double needed = friction + 2.0 * (1.0 - friction);
    const double given = 12.0 * damping * damping * friction * (1.0 - friction);
    EXPECT_NEAR(needed, given, 1e-3 * given);
  }
  // Every servo within it is one that cannot hunt.
  ASSERT_EQ(run_tool(map_into(scratch / "bouncing.json", {"--restitution", "0.5"})).status, 0);
  const auto bouncing = nlohmann::json::parse(file_text(scratch / "bouncing.json"));
  EXPECT_EQ(bouncing["certainty"], "computed for plastic contact, searched for restitution > 0");
}

/// A torque-controlled motor under a PD: it rests, or hunts if disturbed where its gain is high.
constexpr char pd_drive[] = R"(
[motor]
kind = "torque-controlled"
inertia = "2e-5 kg m2"
friction = "1e-5 N m s/rad"
coulomb = "1 mN m"
[gearbox]
ratio = 20
backlash = "2 mrad"
[load]
inertia = "5e-3 kg m2"
friction = "1 mN m s/rad"
coulomb = "5 mN m"
[sensor]
position = "load"
[controller]
kind = "PD"
proportional = "2 N m/rad"
derivative = "0.02 N m s/rad"
filter = "1 ms"
)";

TEST(MapCommand, OfSearchedDrivesHasRegionsOfOneKindOfMotion) {
  const Scratch scratch;
  std::ofstream(scratch / "pd.toml") << pd_drive;
  const Outcome run = run_tool({"map", (scratch / "pd.toml").string(), "--x",
                                "controller.proportional=1 N m/rad:6 N m/rad:13", "--y",
                                "controller.derivative=0.02 N m s/rad:0.04 N m s/rad:2", "--output",
                                (scratch / "map.json").string(), "--plot",
                                "map=" + (scratch / "map.svg").string()});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto map = nlohmann::json::parse(file_text(scratch / "map.json"));
  ASSERT_EQ(map["regions"].size(), 2U);
  EXPECT_EQ(map["regions"][0]["kind"], "comes to rest");
  EXPECT_EQ(map["regions"][1]["kind"], "hunts if disturbed");
  const auto verdicts = map["verdicts"];
  EXPECT_EQ(verdicts[0], "comes to rest");
  EXPECT_EQ(verdicts[12], "hunts if disturbed");
  const std::string svg = file_text(scratch / "map.svg");
  for (const char* text : {"comes to rest", "hunts if disturbed", "border", "ceiling, proved"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  const Outcome alone = run_tool({"map", (scratch / "pd.toml").string(), "--x",
                                  "controller.proportional=1 N m/rad:2 N m/rad:13", "--y",
                                  "controller.derivative=0.02 N m s/rad:0.04 N m s/rad:2", "--plot",
                                  "map=" + (scratch / "alone.svg").string()});
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_THAT(file_text(scratch / "alone.svg"), HasSubstr("ceiling, proved"));
}

TEST(MapCommand, JudgesPointsByATarget) {
  const Scratch scratch;
  const std::vector<std::string> target = {"--target", "amplitude <= 0.5 and multiplier <= 0.9"};
  const Outcome run = run_tool(map_into(scratch / "map.json", target));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto map = nlohmann::json::parse(file_text(scratch / "map.json"));
  EXPECT_EQ(map["target_text"], target[1]);
  const auto& columns = map["columns"];
  std::set<std::string> words;
  for (std::size_t i = 0; i < map["kinds"].size(); ++i) {
    const bool rests = map["verdicts"][i] == "cannot hunt";
    const bool is_met = rests || (columns["amplitude"][i].get<double>() <= 0.5 &&
                                  columns["multiplier"][i].get<double>() <= 0.9);
    EXPECT_EQ(map["kinds"][i], is_met ? "met" : "missed") << i;
    words.insert(map["kinds"][i]);
  }
  EXPECT_EQ(words.size(), 2U);
  ASSERT_EQ(map["regions"].size(), 2U);
  EXPECT_EQ(map["regions"][0]["kind"], "met");
  EXPECT_EQ(map["regions"][1]["kind"], "missed");
  // The other columns are those without a target.
  ASSERT_EQ(run_tool(map_into(scratch / "plain.json")).status, 0);
  const auto plain = nlohmann::json::parse(file_text(scratch / "plain.json"));
  EXPECT_EQ(plain["columns"]["amplitude"], columns["amplitude"]);
  EXPECT_TRUE(plain["kinds"].empty());
  ASSERT_EQ(run_tool(map_into(scratch / "map.csv", target)).status, 0);
  EXPECT_THAT(lines_of(file_text(scratch / "map.csv"))[0],
              StartsWith("damping,friction_ratio,verdict,target,growth_at_rest,"));
}

TEST(MapCommand, ShadesWhereSearchedDrivesMeetATarget) {
  const Scratch scratch;
  std::ofstream(scratch / "pd.toml") << pd_drive;
  const std::vector<std::string> words = {
      "map",      (scratch / "pd.toml").string(),
      "--x",      "controller.proportional=1 N m/rad:6 N m/rad:7",
      "--target", "no-hunting-if-disturbed and bandwidth >= 2.5 Hz"};
  const auto drawn = [&](const std::string& y) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--y", y, "--plot", "map=" + (scratch / "map.svg").string()});
    const Outcome run = run_tool(all);
    EXPECT_EQ(run.status, 0) << run.err;
    return file_text(scratch / "map.svg");
  };
  const std::string svg = drawn("controller.derivative=0.02 N m s/rad:0.04 N m s/rad:3");
  for (const char* text :
       {"Target: no-hunting-if-disturbed and bandwidth", ">met<", ">missed<", ">limit<", ">now<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(drawn("sensor.position=load,motor"), HasSubstr("framed: no-hunting-if-disturbed"));
}

TEST(EdgeMapCommand, AFaultyTargetIsNamed) {
  const Scratch scratch;
  const Outcome run = run_tool(map_into(scratch / "map.svg", {"--target", "colour <= 3"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, StartsWith("gearlash: --target = colour <= 3: must be no-hunting"));
  const Outcome timeless =
      run_tool(map_into(scratch / "map.svg", {"--target", "frequency >= 3 Hz"}));
  EXPECT_EQ(timeless.status, 2);
  EXPECT_THAT(timeless.err, HasSubstr("--target = frequency >= 3 Hz: needs a time scale"));
}

TEST(MapCommand, TableHasALineAPoint) {
  const Scratch scratch;
  EXPECT_EQ(run_tool(map_into(scratch / "map.csv")).status, 0);
  const auto lines = lines_of(file_text(scratch / "map.csv"));
  ASSERT_EQ(lines.size(), 1U + 9U * 13U);
  EXPECT_THAT(lines[0], StartsWith("damping,friction_ratio,verdict,growth_at_rest,"));
}

TEST(MapCommand, PicturesAreDrawn) {
  const Scratch scratch;
  for (const char* file : {"map.svg", "map.PNG", "map.pdf"}) {
    const Outcome run = run_tool(map_into(scratch / file));
    EXPECT_EQ(run.status, 0) << run.err;
  }
  EXPECT_THAT(file_text(scratch / "map.PNG"), StartsWith("\x89PNG\r\n"));
  EXPECT_THAT(file_text(scratch / "map.pdf"), StartsWith("%PDF-"));
  const std::string svg = file_text(scratch / "map.svg");
  for (const char* text : {"Amplitude of the load (backlashes)", "friction ratio", "damping",
                           "hunting ends", "comes to rest", ">0.5<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(MapCommand, WhatIsNotThereIsNotInTheLegend) {
  const Scratch scratch;
  const Outcome run = run_tool({"map", "--x", "friction-ratio=0.2:0.8:5", "--y",
                                "damping=0.05:0.2:5", "--inertia-ratio", "1", "--quantity",
                                "period", "--output", (scratch / "map.svg").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(file_text(scratch / "map.svg"),
              testing::AllOf(HasSubstr(">hunts<"), HasSubstr(">period<")));
  EXPECT_THAT(file_text(scratch / "map.svg"), Not(HasSubstr("hunting ends")));
  EXPECT_THAT(file_text(scratch / "map.svg"), Not(HasSubstr("comes to rest")));
}

TEST(MapCommand, QuantitiesOfAnyInputAreDrawn) {
  const Scratch scratch;
  const auto file = (scratch / "map.svg").string();
  for (const char* quantity : {"growth_at_rest", "size", "load-friction-loss"}) {
    EXPECT_EQ(run_tool(map_into(file, {"--quantity", quantity})).status, 0) << quantity;
  }
  EXPECT_EQ(run_tool({"map", "--x", "backlash=0.1:10:5:log", "--y", "inertia_ratio=1/9,1,9",
                      "--damping", "0.3", "--friction-ratio", "0.2", "--output", file})
                .status,
            0);
  EXPECT_THAT(file_text(file), HasSubstr("Amplitude of the load (rad)"));
  EXPECT_EQ(run_tool({"map", "--x", "restitution=0:0.4:4", "--y", "damping=0.2:0.6:4",
                      "examples/elinco-fd162.toml", "--output", file})
                .status,
            0);
}

TEST(MapCommand, AFineGridMakesASmallPicture) {
  const Scratch scratch;
  const auto file = scratch / "map.svg";
  const Outcome run =
      run_tool({"map", "--x", "inertia-ratio=0.05:20:400:log", "--y", "damping=0.02:1:400",
                "--friction-ratio", "0.2", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_LT(std::filesystem::file_size(file), 100'000U);
}

/// The one fault of a map with these axes, all else being sound.
std::string fault_of_axes(const std::string& x, const std::string& y, const std::string& file) {
  const Scratch scratch;
  std::vector<std::string> arguments = {
      "map", "--x", x, "--y", y, "--friction-ratio", "0.5", "--output", (scratch / file).string()};
  if (y.starts_with("damping")) arguments.insert(arguments.end(), {"--inertia-ratio", "0.5"});
  const Outcome run = run_tool(arguments);
  EXPECT_EQ(run.status, 2) << run.out;
  EXPECT_EQ(lines_of(run.err).size(), 1U) << run.err;
  EXPECT_EQ(scratch.file_count(), 0U);
  return run.err;
}

TEST(EdgeMapAxes, EachFaultOfTwoIsOneLine) {
  EXPECT_EQ(fault_of_axes("damping=0.1:0.5:5", "damping=0.1:0.5:5", "a.csv"),
            "gearlash: --x = servo.damping: must be another parameter than that of --y\n");
  EXPECT_EQ(fault_of_axes("damping=0.5", "inertia-ratio=1:2:3", "a.csv"),
            "gearlash: --x = 1 value: must have two values or more; gearlash chart draws a single "
            "line\n");
  EXPECT_THAT(fault_of_axes("damping=0.1:0.5:5", "inertia-ratio=1,2,inf", "a.svg"),
              StartsWith("gearlash: --y = inf: must be finite in a picture"));
  EXPECT_THAT(fault_of_axes("damping=0.3:0.300000001:20", "inertia-ratio=1,2", "a.svg"),
              StartsWith("gearlash: --x = 0.3 to 0.300000001: must span 0.001 of itself or more"));
  EXPECT_EQ(run_tool({"map", "--x", "damping=0.1:0.5:5", "--output", "a.csv"}).err,
            "gearlash: --y is missing: must be given as --y AXIS; see gearlash map --help\n");
}

TEST(MapCommand, ASearchedMapIsDrawnCellByCell) {
  const Scratch scratch;
  const Outcome run =
      run_tool({"map", GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml", "--x",
                "sensor.position=load,motor", "--y", "gearbox.backlash=10 arcmin,20 arcmin",
                "--plot", "map=" + (scratch / "map.svg").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("map.svg: 4 drives, 2 solved side by side, 0 one by one, 2 "
                                 "searched\n"));
  const std::string svg = file_text(scratch / "map.svg");
  for (const char* text : {"sensor position", "gearbox backlash (rad)", ">motor<", "searched"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(MapCommand, APlaceThatCannotBeWrittenIsToldBeforeTheWork) {
  const Scratch scratch;
  // Ten million servos that bounce would take hours.
  const Outcome run = run_tool({"map", "--x", "friction-ratio=0.05:0.95:5000", "--y",
                                "damping=0.1:0.8:2000", "--inertia-ratio", "2", "--restitution",
                                "0.3", "--output", (scratch / "missing" / "map.svg").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("missing/map.svg: must be a file that can be written (No such"));
}

}  // namespace
}  // namespace gearlash::map_command_test
