// gearlash chart as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "gearlash/cycle/limit_cycle.hpp"
#include "tool.hpp"

namespace gearlash {
namespace {

using test::Outcome;
using test::run_tool;
using testing::HasSubstr;

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(ChartCommand, CurvesAreSingleCalls) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.json";
  const Outcome run =
      run_tool({"chart", "--x", "inertia-ratio=1/9:9:21:log", "--curves", "damping=0.1,0.3,0.6",
                "--friction-ratio", "0.1", "--backlash", "0.3", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto chart = nlohmann::json::parse(content(file));
  ASSERT_EQ(chart["size"].size(), 63U);
  EXPECT_EQ(chart["axes"][0]["input"], "damping");
  EXPECT_FALSE(chart["servo"].contains("damping"));
  EXPECT_EQ(chart["servo"]["backlash"], 0.3);
  for (std::size_t i = 0; i < 63; ++i) {
    const NormalizedServo servo{.damping = chart["axes"][0]["values"][i / 21],
                                .inertia_ratio = chart["axes"][1]["values"][i % 21],
                                .friction_ratio = 0.1,
                                .backlash = 0.3};
    const LimitCycleAnalysis single = analyse_limit_cycles(servo);
    EXPECT_EQ(chart["verdict"][i], name_of(single.verdict));
    if (single.cycles.empty()) {
      EXPECT_TRUE(chart["size"][i].is_null());
    } else {
      const double size = chart["size"][i];
      EXPECT_NEAR(size, single.cycles.front().size, 1e-12 * size);
    }
  }
}

TEST(ChartCommand, TableHasALineAPoint) {
  const test::Scratch scratch;
  const auto file = scratch / "table.csv";
  const Outcome run = run_tool({"chart", "--x", "friction-ratio=0:1:5", "--damping", "0.5",
                                "--inertia-ratio", "1", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string text = content(file);
  EXPECT_THAT(text,
              HasSubstr("\n# damping = 0.5, inertia_ratio = 1, backlash = 1, restitution = 0\n"));
  EXPECT_THAT(text, HasSubstr("\nfriction_ratio,verdict,growth_at_rest,size,"));
  EXPECT_THAT(text, HasSubstr("\n0.5,cannot hunt,"));
  EXPECT_EQ(text.substr(text.rfind("\n1,") + 1, 8), "1,hunts,");
}

TEST(ChartCommand, PicturesAreDrawn) {
  const test::Scratch scratch;
  for (const char* ending : {"svg", "png", "pdf"}) {
    const auto file = scratch / (std::string("chart.") + ending);
    EXPECT_EQ(run_tool({"chart", "--x", "inertia-ratio=0.1:10:50:log", "--curves",
                        "damping=0.2,0.5", "--friction-ratio", "0.2", "--output", file.string()})
                  .status,
              0);
    EXPECT_GT(std::filesystem::file_size(file), 1000U);
  }
  const std::string svg = content(scratch / "chart.svg");
  EXPECT_THAT(svg, HasSubstr("hunting ends"));
  EXPECT_THAT(svg, HasSubstr("size (backlashes)"));
}

TEST(ChartCommand, InfinityIsToldInWords) {
  const test::Scratch scratch;
  const auto file = scratch / "chart.json";
  const Outcome run = run_tool({"chart", "--x", "inertia-ratio=0,1,inf", "--damping", "0.1",
                                "--friction-ratio", "0.5", "--output", file.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto chart = nlohmann::json::parse(content(file));
  EXPECT_EQ(chart["axes"][0]["values"], nlohmann::json({0.0, 1.0, "inf"}));
}

TEST(ChartCommand, FaultsAreToldAtOnce) {
  const Outcome run = run_tool({"chart", "--x", "damping=0.6:0.1:5", "--curves", "stiffness=1",
                                "--inertia-ratio", "1", "--friction-ratio", "2", "--quantity",
                                "weight", "--output", "a.txt", "--damping", "0.2"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--curves = stiffness: must name an input: "));
  EXPECT_THAT(run.err, HasSubstr("--x = 0.6 to 0.1: must rise"));
  EXPECT_THAT(run.err, HasSubstr("--quantity = weight: must be growth_at_rest, size, "));
  EXPECT_THAT(run.err,
              HasSubstr("--output = a.txt: must end in .svg, .png, .pdf, .csv, .json or .nc"));
  EXPECT_THAT(run.err, HasSubstr("--friction-ratio = 2: must be from 0 to 1"));
  const Outcome twice =
      run_tool({"chart", "--x", "damping=0.1:0.6:5", "--damping", "0.2", "--inertia-ratio", "1",
                "--friction-ratio", "0.2", "--output", "a.csv"});
  EXPECT_EQ(twice.err, "gearlash: --damping = 0.2: must be left out: --x varies it\n");
  const Outcome many =
      run_tool({"chart", "--x", "damping=0.1:0.6:1000000", "--curves", "backlash=1:2:1000",
                "--inertia-ratio", "1", "--friction-ratio", "0.2", "--output", "a.csv"});
  EXPECT_EQ(many.err,
            "gearlash: points = 1000000000: must be at most 10000000 on both axes together: they "
            "are held in memory\n");
  const Outcome missing = run_tool({"chart", "--output", "a.csv"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err, "gearlash: --x is required; see gearlash chart --help\n");
}

}  // namespace
}  // namespace gearlash
