// Every verb that may take long stops at a limit and at Ctrl-C, prints what it knows by then, and
// says what is not known.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "tool.hpp"

namespace gearlash::limits_of_work_test {
namespace {

using test::file_text;
using test::Outcome;
using test::quoted;
using test::run_shell;
using test::run_tool;
using test::Scratch;
using test::tool_path;
using testing::HasSubstr;
using testing::StartsWith;

constexpr char at_once[] = " --time-limit '1 us'";

TEST(LimitsOfWork, StopEachVerbWhichPrintsWhatIsKnown) {
  const std::string joint = " examples/robot-joint.toml";
  const std::string stopped = "gearlash: stopped by --time-limit: ";
  for (const auto& [command, answer, unknown] :
       {std::tuple("limit-cycle" + joint, "undecided", "undecided; stopped early"),
        std::tuple("simulate" + joint, "time_s,", "the motion is known up to 0 s of "),
        std::tuple("design" + joint + " --target no-hunting --parameters gearbox.backlash",
                   "target: no-hunting", "1 of 1 parameters is not searched to the end"),
        std::tuple(std::string("design examples/elinco-fd162.toml --target no-hunting --parameters "
                               "load.friction,gearbox.ratio"),
                   "target: no-hunting", "2 of 2 parameters are not searched to the end"),
        std::tuple("tune" + joint, "target: ", "the values are the best by then"),
        std::tuple(std::string("tolerance examples/toleranced-joint.toml"),
                   "Of the 0 samples, out of 64, that were answered before the stop\n",
                   "64 of 64 samples are not answered"),
        std::tuple("compare" + joint, "  load   undecided; stopped early",
                   "searches are not complete, or not begun"),
        std::tuple("describe" + joint, "undecided; stopped early", "the search is not complete"),
        std::tuple(std::string("thesis run --all"), "Errors of the program's amplitudes",
                   "0 of 160 servos are run"),
        std::tuple(std::string("thesis run --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1"),
                   "The program of 1960", "the amplitude had not settled")}) {
    const Outcome run = run_shell("\"$GEARLASH\" " + command + at_once);
    EXPECT_EQ(run.status, 1) << command;
    EXPECT_THAT(run.out, StartsWith(answer)) << command;
    EXPECT_THAT(run.err, HasSubstr(stopped + unknown)) << command;
  }
}

TEST(LimitsOfWork, AMapAndAChartHaveThePointsThatAreKnown) {
  const Scratch scratch;
  for (const std::string ending : {"json", "nc", "csv"}) {
    const std::string file = (scratch / ("a." + ending)).string();
    const Outcome run = run_shell(
        "\"$GEARLASH\" chart examples/robot-joint.toml --x "
        "gearbox.ratio=10:20:11 --output " +
        quoted(file) + at_once);
    EXPECT_EQ(run.status, 1) << ending;
    EXPECT_THAT(run.out, HasSubstr("0 servos")) << ending;
    EXPECT_THAT(run.err, HasSubstr("stopped by --time-limit: 0 of 11 points are known")) << ending;
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  const auto table = nlohmann::json::parse(file_text(scratch / "a.json"));
  EXPECT_EQ(table["verdicts"], std::vector<std::string>(11, "undecided"));
}

TEST(LimitsOfWork, ASweepCanBeResumed) {
  const Scratch scratch;
  const std::string sweep =
      "\"$GEARLASH\" sweep examples/sweep.toml --output " + quoted((scratch / "a.nc").string());
  const Outcome run = run_shell(sweep + at_once);
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("stopped before the first of "));
  EXPECT_EQ(scratch.file_count(), 0U);
}

TEST(LimitsOfWork, JsonSaysThatTheWorkWasStopped) {
  const auto design = nlohmann::json::parse(
      run_shell("\"$GEARLASH\" design examples/elinco-fd162.toml --target no-hunting "
                "--parameters load.friction --format json" +
                std::string(at_once))
          .out);
  EXPECT_EQ(design["design"]["parameters"][0]["values"]["stopped"], true);
  const auto tolerance = nlohmann::json::parse(
      run_shell("\"$GEARLASH\" tolerance examples/toleranced-joint.toml --format json" +
                std::string(at_once))
          .out);
  EXPECT_EQ(tolerance["stopped"], true);
  EXPECT_EQ(tolerance["study"]["answered"], 0);
  EXPECT_EQ(tolerance["study"]["hunting"]["value"], nullptr);
  const auto motion = nlohmann::json::parse(
      run_shell("\"$GEARLASH\" simulate examples/robot-joint.toml --format json" +
                std::string(at_once))
          .out);
  EXPECT_EQ(motion["stop"], "stopped");
}

/// The search takes some 130 MB, and the tool by itself less than a third of that.
TEST(LimitsOfWork, OfMemory) {
  if (!test::may_limit_memory) GTEST_SKIP() << "sanitizers take more memory than permitted";
  const Outcome run =
      run_tool({"describe", "tests/regression/data/continuous/slides-for-hours.toml",
                "--memory-limit", "100 MB"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, StartsWith("undecided; stopped early"));
  EXPECT_THAT(run.err, HasSubstr("stopped by --memory-limit: the search is not complete"));
}

TEST(LimitsOfWork, AnAnswerIsPrintedAtControlC) {
  const Scratch scratch;
  const std::string terminal = quoted((scratch / "terminal").string());
  // It takes minutes; Ctrl-C is typed as soon as there is progress.
  std::ofstream(scratch / "work") << "exec " << quoted(tool_path())
                                  << " design examples/robot-joint.toml --target no-hunting\n";
  const Outcome run =
      run_shell("{ for turn in {1..1200}; do grep -qs 'Design:' " + terminal +
                " && break; sleep 0.05; done; printf '\\003'; } | script -qfec \"bash " +
                (scratch / "work").string() + "\" " + terminal + " >&2");
  EXPECT_EQ(run.status, 130);
  EXPECT_THAT(file_text(scratch / "terminal"), HasSubstr("target: no-hunting"));
  EXPECT_THAT(file_text(scratch / "terminal"), HasSubstr("gearlash: stopped by a signal: "));
}

}  // namespace
}  // namespace gearlash::limits_of_work_test
