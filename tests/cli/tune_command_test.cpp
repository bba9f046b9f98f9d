// gearlash tune: values for a series, its limiting unit, and the file that it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "gearlash/input.hpp"
#include "tool.hpp"

namespace gearlash::tune_command_test {
namespace {

using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::AllOf;
using testing::HasSubstr;

TEST(TuneCommand, TheDriveThatItWritesMeetsTheTarget) {
  const Scratch scratch;
  const std::string file = (scratch / "tuned.toml").string();
  const Outcome run =
      run_tool({"tune", "examples/elinco-fd162.toml", "--target", "no-hunting", "--phase-margin",
                "0 deg", "--parameters", "controller.proportional=0.001 V/rad:1 V/rad", "--write",
                file, "--format", "json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["tuned"]["meets"], true);
  EXPECT_EQ(json["nominal"]["verdict"], "cannot hunt");
  const Outcome back = run_tool({"limit-cycle", file, "--format", "json"});
  ASSERT_EQ(back.status, 0) << back.err;
  const auto answer = nlohmann::json::parse(back.out);
  EXPECT_EQ(answer["verdict"], "cannot hunt");
  EXPECT_EQ(answer["drive"]["controller.proportional"], json["tuned"]["values"][0]);
}

TEST(TuneCommand, OfASeriesNamesTheUnitThatLimits) {
  const Scratch scratch;
  const std::string file = (scratch / "tuned.toml").string();
  const Outcome run = run_tool({"tune", "examples/toleranced.toml", "--target", "no-hunting",
                                "--phase-margin", "0 deg", "--units", "16", "--write", file});
  ASSERT_EQ(run.status, 0) << run.err;
  // What is not tuned keeps its tolerance.
  TolerancedDrive given = read_toleranced_drive(std::filesystem::path(GEARLASH_SOURCE_DIRECTORY) /
                                                "examples/toleranced.toml");
  EXPECT_EQ(std::erase_if(given.varied,
                          [](const auto& one) { return one.path == "controller.proportional"; }),
            1U);
  EXPECT_EQ(read_toleranced_drive(file).varied, given.varied);
  EXPECT_THAT(run.out, AllOf(HasSubstr("All 16 units tried meet the target, with a bandwidth of"),
                             HasSubstr("The unit that limits, as an earlier proposal had it:"),
                             HasSubstr("Searched, not proved")));
}

TEST(TuneCommand, SaysWhatToGiveUpWhereNothingMeetsTheTarget) {
  const Outcome run =
      run_tool({"tune", "examples/robot-joint.toml", "--target", "no-runaway", "--phase-margin",
                "20 deg", "--set", "controller.kind=PI", "--set", "gearbox.backlash=0.1 deg",
                "--set", "load.friction=0.2 N m s/rad", "--parameters",
                "controller.proportional=20 V/rad:40 V/rad,"
                "controller.integral=200 V/(rad s):400 V/(rad s)"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("Nothing found that meets the target"),
                             HasSubstr("its linear loop lacks the phase margin"),
                             HasSubstr("Without integral action: The drive meets the target")));
}

TEST(TuneCommand, SaysThatAValueIsAtTheEndOfItsRangeUnlessItMustEndThere) {
  const auto tuned = [](const std::string& range, const std::string& format) {
    return run_tool({"tune", "examples/elinco-fd162.toml", "--target", "no-hunting",
                     "--phase-margin", "0 deg", "--parameters", "controller.proportional=" + range,
                     "--format", format});
  };
  // The greatest bandwidth without hunting is that at 0.374 V/rad.
  const std::string note =
      "controller.proportional ends at the end of its range, 0.1 V/rad: a wider range may be "
      "better";
  EXPECT_THAT(tuned("0.01 V/rad:0.1 V/rad", "text").out, HasSubstr(note));
  const auto json = nlohmann::json::parse(tuned("0.01 V/rad:0.1 V/rad", "json").out);
  EXPECT_EQ(json["notes"][0]["code"], "range-end");
  EXPECT_THAT(json["notes"][0]["text"].get<std::string>(), HasSubstr(note));
  EXPECT_EQ(nlohmann::json::parse(tuned("0.01 V/rad:1 V/rad", "json").out)["notes"].size(), 0U);
}

TEST(EdgeTuneCommand, FaultsAreToldAtOnce) {
  const Outcome run =
      run_tool({"tune", "examples/robot-joint.toml", "--for", "beauty", "--share", "0", "--units",
                "0", "--parameters", "load.colour,controller.kind", "--target", "amplitude >= 2 kg",
                "--write", "examples/robot-joint.toml"});
  EXPECT_EQ(run.status, 2);
  for (const char* text : {"--for = beauty", "--share = 0", "--units = 0", "load.colour",
                           "--target = amplitude >= 2 kg", "--write"}) {
    EXPECT_THAT(run.err, HasSubstr(text));
  }
}

}  // namespace
}  // namespace gearlash::tune_command_test
