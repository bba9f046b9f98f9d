// gearlash chart as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "closed_form/limit_cycle.hpp"
#include "tool.hpp"

namespace gearlash::chart_command_test {
namespace {

using test::file_text;
using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

TEST(ChartCommand, CurvesAreSingleCalls) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.json";
  const Outcome run =
      run_tool({"chart", "--x", "inertia-ratio=1/9:9:21:log", "--curves", "damping=0.1,0.3,0.6",
                "--friction-ratio", "0.1", "--backlash", "0.3", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto chart = nlohmann::json::parse(file_text(file));
  const auto& columns = chart["columns"];
  ASSERT_EQ(columns["amplitude"].size(), 63U);
  EXPECT_EQ(chart["axes"][0]["path"], "servo.damping");
  EXPECT_FALSE(chart["drive"].contains("servo.damping"));
  EXPECT_EQ(chart["drive"]["servo.backlash"], 0.3);
  for (std::size_t i = 0; i < 63; ++i) {
    const NormalizedServo servo{.damping = chart["axes"][0]["values"][i / 21],
                                .inertia_ratio = chart["axes"][1]["values"][i % 21],
                                .friction_ratio = 0.1,
                                .backlash = 0.3};
    const LimitCycleAnalysis single = analyse_limit_cycles(servo);
    EXPECT_EQ(chart["verdicts"][i], name_of(single.verdict));
    const double amplitude = columns["amplitude"][i];
    if (single.cycles.empty()) {
      EXPECT_EQ(amplitude, 0.0);
      EXPECT_TRUE(columns["period"][i].is_null());
    } else {
      EXPECT_NEAR(amplitude, single.cycles.front().amplitude, 1e-12 * amplitude);
    }
  }
}

TEST(ChartCommand, BifurcationPicturesHaveBranchesAndBorders) {
  const test::Scratch scratch;
  const std::string file = (scratch / "branches.svg").string();
  const Outcome run =
      run_tool({"chart", "--x", "damping=0.1:0.9:9", "--inertia-ratio", "2", "--friction-ratio",
                "0.1", "--backlash", "0.3 deg", "--plot", "bifurcation=" + file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, file + ": 1 branches, 1 borders\n");
  EXPECT_THAT(file_text(file), testing::AllOf(HasSubstr("stable cycle"), HasSubstr("loss of rest"),
                                              HasSubstr("amplitude (deg)"),
                                              HasSubstr("<title>Cycles over damping: amplitude")));
}

TEST(EdgeChartCommand, WhatABifurcationPictureCannotShowIsToldAtOnce) {
  const Outcome run =
      run_tool({"chart", "--x", "damping=0.5", "--curves", "inertia-ratio=1,2", "--friction-ratio",
                "0.1", "--quantity", "growth_at_rest", "--plot", "bifurcation=a.svg"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --curves = given: must be left out: bifurcation=FILE has branches\n"
            "gearlash: --x = 1 values: must have 2 to 1000 numbers for bifurcation=FILE\n"
            "gearlash: --quantity = growth_at_rest: must be amplitude, motor_amplitude, period, "
            "frequency or multiplier for bifurcation=FILE\n");
}

TEST(ChartCommand, InfinityIsToldInWords) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.json";
  const Outcome run = run_tool({"chart", "--x", "inertia-ratio=0,1,inf", "--damping", "0.1",
                                "--friction-ratio", "0.5", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto chart = nlohmann::json::parse(file_text(file));
  EXPECT_EQ(chart["axes"][0]["values"], nlohmann::json({0.0, 1.0, "inf"}));
}

/// The picture of a chart over this axis.
std::string chart_over(const std::string& x, const std::vector<std::string>& more = {}) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.svg";
  std::vector<std::string> arguments = {"chart", "--x", x, "--output", file.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome run = run_tool(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return file_text(file);
}

TEST(ChartCommand, PicturesShowWhereHuntingEnds) {
  EXPECT_THAT(chart_over("inertia-ratio=0.1:10:50:log",
                         {"--curves", "damping=0.2,0.5", "--friction-ratio", "0.2"}),
              testing::AllOf(HasSubstr("hunting ends"), HasSubstr("amplitude (backlashes)")));
}

TEST(EdgeChartCommand, WhereNothingHuntsThePictureSaysSo) {
  EXPECT_THAT(chart_over("damping=0.7:0.9:5", {"--inertia-ratio", "1", "--friction-ratio", "0.5"}),
              testing::AllOf(HasSubstr("no limit cycle"), HasSubstr("damping")));
  EXPECT_THAT(chart_over("backlash=0",
                         {"--inertia-ratio", "1", "--friction-ratio", "0.5", "--damping", "0.2"}),
              HasSubstr("no limit cycle"));
  EXPECT_THAT(chart_over("friction-ratio=0,1", {"--inertia-ratio", "1", "--damping", "0.2",
                                                "--quantity", "growth_at_rest"}),
              testing::AllOf(HasSubstr("infinite"), testing::Not(HasSubstr("no limit cycle"))));
  const std::string family =
      chart_over("damping=0.7:0.9:5", {"--curves", "inertia-ratio=1,2", "--friction-ratio", "0.5"});
  EXPECT_THAT(family, testing::AllOf(HasSubstr("no limit cycle"), HasSubstr("ratio 2: rests")));
}

TEST(EdgeChartCommand, OneServoIsAMark) {
  const std::string svg =
      chart_over("damping=0.3", {"--inertia-ratio", "1", "--friction-ratio", "0.1"});
  EXPECT_THAT(svg, HasSubstr("<use xlink:href='#gpPt4'"));
  EXPECT_THAT(svg, HasSubstr(">0.3<"));
}

TEST(EdgeChartCommand, WhatNoPictureShowsIsRefusedInPicturesOnly) {
  const test::Scratch scratch;
  const struct {
    const char* x;
    const char* curves;
    const char* fault;
  } cases[] = {{"damping=0.3:0.300000001:20", "inertia-ratio=1,2",
                "--x = 0.3 to 0.300000001: must span 0.001 of itself or more"},
               {"damping=0.1:0.6:5", "inertia-ratio=0.1:10:60:log",
                "--curves = 60 values: must be at most 16"}};
  for (const auto& [x, curves, fault] : cases) {
    for (const char* ending : {"svg", "csv"}) {
      const auto file = scratch / (std::string("chart.") + ending);
      const Outcome run = run_tool({"chart", "--x", x, "--curves", curves, "--friction-ratio",
                                    "0.3", "--output", file.string()});
      const bool is_table = ending == std::string("csv");
      EXPECT_EQ(run.status, is_table ? 0 : 2);
      EXPECT_EQ(run.err, is_table ? ""
                                  : std::string("gearlash: ") + fault +
                                        " in a picture; tables (.csv, .json, .nc) may have it\n");
    }
  }
}

/// How many bands of ink lie one above another from the x axis of a PNG down, in the middle third
/// of its width.
std::size_t bands_below_axis(const std::filesystem::path& png) {
  const Outcome pixels = test::run_shell(
      "exec gnuplot -d -e \"set table; plot '" + png.string() +
      "' binary filetype=png every 2:1:600:0:1200 using 1 with image\" | awk '$3 ~ /^[0-9]+$/ && "
      "NF == 4 { if ($3 < 200) ink[$2]++ } END { for (y = 0; y < 1400; ++y) print ink[y] + 0 }'");
  std::size_t bands = 0;
  bool was_ink = false;
  for (const std::string& row : test::lines_of(pixels.out)) {
    const int ink = std::stoi(row);
    if (ink > 250) return bands;  // the axis
    if (ink > 0 && !was_ink) ++bands;
    was_ink = ink > 0;
  }
  return 0;
}

TEST(ChartCommand, TheLegendOfAPngIsClearOfTheAxis) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.png";
  const struct {
    const char* curves;
    std::size_t rows;
  } cases[] = {{"3", 2}, {"5", 2}, {"6", 3}, {"9", 4}, {"16", 6}};
  for (const auto& [curves, rows] : cases) {
    const Outcome run = run_tool({"chart", "--x", "damping=0.1:0.6:50", "--curves",
                                  std::string("inertia-ratio=0.1:10:") + curves + ":log",
                                  "--friction-ratio", "0.3", "--output", file.string()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(bands_below_axis(file), rows + 3) << curves;  // tics, numbers and label
  }
}

TEST(ChartCommand, APictureThatFailsDoesNotWithholdTheTable) {
  const test::Scratch scratch;
  const std::string chart =
      "\"$GEARLASH\" chart --x damping=0.1:0.6:5 --inertia-ratio 1 "
      "--friction-ratio 0.2 --plot curves=" +
      test::quoted((scratch / "a.svg").string()) + " --output " +
      test::quoted((scratch / "a.csv").string());
  const Outcome run = test::run_shell("mkdir " + test::quoted((scratch / "bin").string()) +
                                      " && PATH=" + test::quoted((scratch / "bin").string()) +
                                      "; export PATH; " + chart);
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("gnuplot"));
  EXPECT_THAT(run.out, HasSubstr("a.csv: 5 servos, "));
  EXPECT_THAT(file_text(scratch / "a.csv"), testing::StartsWith("damping,verdict,"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.svg"));
}

TEST(ChartCommand, AnyDriveIsSearched) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.json";
  const Outcome run = run_tool({"chart", GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml",
                                "--x", "sensor.position=load,motor", "--output", file.string(),
                                "--plot", "curves=" + (scratch / "chart.svg").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("2 drives, 1 solved side by side, 0 one by one, 1 searched\n"));
  const auto chart = nlohmann::json::parse(file_text(file));
  EXPECT_EQ(chart["certainty"], "computed in closed form, searched elsewhere");
  EXPECT_EQ(chart["axes"][0]["values"], nlohmann::json({"load", "motor"}));
  EXPECT_THAT(file_text(scratch / "chart.svg"), HasSubstr("sensor position"));
}

TEST(ChartCommand, FaultsAreToldAtOnce) {
  const Outcome run = run_tool({"chart", "--x", "damping=0.6:0.1:5", "--curves", "stiffness=1",
                                "--inertia-ratio", "1", "--friction-ratio", "2", "--quantity",
                                "weight", "--output", "a.txt", "--damping", "0.2"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err,
              HasSubstr("--curves = stiffness: must be a number or a choice of this drive"));
  EXPECT_THAT(run.err, HasSubstr("--x = 0.6 to 0.1: must rise"));
  EXPECT_THAT(run.err, HasSubstr("--quantity = weight: must be growth_at_rest, amplitude, "));
  EXPECT_THAT(run.err,
              HasSubstr("--output = a.txt: must end in .svg, .png, .pdf, .csv, .json or .nc"));
  EXPECT_THAT(run.err, HasSubstr("--friction-ratio = 2: must be from 0 to 1"));
  const Outcome twice =
      run_tool({"chart", "--x", "damping=0.1:0.6:5", "--damping", "0.2", "--inertia-ratio", "1",
                "--friction-ratio", "0.2", "--output", "a.csv"});
  EXPECT_EQ(twice.err, "gearlash: --damping = 0.2: must be left out: --x varies it\n");
  const Outcome nowhere = run_tool(
      {"chart", "--x", "damping=0.1:0.6:5", "--inertia-ratio", "1", "--friction-ratio", "0.2"});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("--output is missing: must be given, or --plot curves=FILE"));
  const Outcome missing = run_tool({"chart", "--output", "a.csv"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err,
            "gearlash: --x is missing: must be given as --x AXIS; see gearlash chart --help\n");
}

TEST(ChartCommand, LeavesOutValuesThatAreNotPermittedAndSaysSo) {
  const test::Scratch scratch;
  const Outcome run =
      run_tool({"chart", "--x", "restitution=0:2:5", "--damping", "0.2", "--inertia-ratio", "1",
                "--friction-ratio", "0.2", "--output", (scratch / "a.csv").string()});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("a.csv: 3 servos, "));
  EXPECT_EQ(run.err,
            "gearlash: --x restitution: left out: 1.5 and 1 more (contact.restitution must "
            "be from 0 to 1)\n");
}

TEST(ChartCommand, SaysWhyAPointIsRefused) {
  const test::Scratch scratch;
  const Outcome run =
      run_tool({"chart", "examples/robot-joint.toml", "--x", "gearbox.backlash=0 deg,2 deg",
                "--output", (scratch / "a.csv").string()});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, testing::StartsWith("gearlash: 1 of 2 points refused, the first at "
                                           "gearbox.backlash = 0: gearbox.backlash = 0 rad: must "
                                           "be positive"));
}

}  // namespace
}  // namespace gearlash::chart_command_test
