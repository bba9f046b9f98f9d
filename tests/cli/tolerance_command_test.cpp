// gearlash tolerance as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::tolerance_command_test {
namespace {

using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A servo of which only the backlash varies, from 0.1 to 0.3 rad.
std::string only_backlash(const Scratch& scratch) {
  const auto path = scratch / "servo.toml";
  std::ofstream(path) << "[servo]\ndamping = 0.19\ninertia_ratio = 2\nfriction_ratio = 0.1\n"
                         "backlash = { min = \"0.1 rad\", max = \"0.3 rad\" }\n";
  return path.string();
}

nlohmann::json study_of(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"tolerance"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {"--format", "json"});
  const Outcome run = run_tool(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

TEST(ToleranceCommand, SizesAreDistributedAsTheBacklash) {
  const Scratch scratch;
  const auto report =
      study_of({only_backlash(scratch), "--target", "size <= 0.2", "--yield", "0.5"});
  const auto& study = report["study"];
  constexpr double amplitude_per_backlash = 0.241611108 / 0.3;
  EXPECT_EQ(study["hunting"]["value"], 1.0);
  for (const auto& quantile : study["amplitude"]) {
    const double backlash = 0.1 + 0.2 * quantile["share"].get<double>();
    EXPECT_NEAR(quantile["value"]["value"], backlash * amplitude_per_backlash, 1e-4);
  }
  EXPECT_NEAR(study["yield"]["value"], (0.2 / amplitude_per_backlash - 0.1) / 0.2, 1e-4);
  // Half of the pieces from 0.1 to max are at most as large as the target permits.
  EXPECT_NEAR(report["backlash"]["max"], 0.1 + 2.0 * (0.2 / amplitude_per_backlash - 0.1), 1e-3);
  const auto& numbers = report["sensitivities"]["numbers"];
  ASSERT_EQ(numbers.size(), 1U);
  EXPECT_NEAR(numbers[0]["of_amplitude"]["first_order"]["value"], 1.0, 1e-3);
  EXPECT_EQ(report["worst"]["numbers"][0]["value"], 0.3);
  EXPECT_NEAR(report["worst"]["result"]["amplitude"], 0.241611108, 1e-9);
  // The ceiling is 0.8542 backlashes (OracleCeiling).
  EXPECT_NEAR(report["proved"]["bound"], 0.8542 * 0.3, 1e-4);
  EXPECT_EQ(report["proved"]["reason"], nullptr);
  const Outcome text = run_tool({"tolerance", only_backlash(scratch), "--samples", "512"});
  EXPECT_THAT(text.out, HasSubstr("Proved: no sample within the tolerances swings by more than "
                                  "±0.2563 rad"));
}

TEST(ToleranceCommand, TheSameSeedGivesTheSameStudy) {
  const std::vector<std::string> arguments = {
      "tolerance", "examples/toleranced.toml", "--samples", "1000", "--seed", "7"};
  const Outcome once = run_tool(arguments);
  EXPECT_EQ(once.status, 0) << once.err;
  EXPECT_EQ(run_tool(arguments).out, once.out);
  EXPECT_THAT(once.out, HasSubstr("1024 samples: 16 times 64 points"));
  EXPECT_THAT(lines_of(once.out), Contains(StartsWith("  load.friction ")));
}

TEST(ToleranceCommand, DistributionsAreDrawn) {
  const Scratch scratch;
  const auto run_with = [](const std::string& plot) {
    return run_tool({"tolerance", "examples/toleranced.toml", "--samples", "200", "--plot", plot});
  };
  const Outcome run = run_with("distribution=" + (scratch / "a.svg").string());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(test::file_text(scratch / "a.svg"), HasSubstr("Amplitudes of a production run"));
  EXPECT_EQ(run_with("size=a.svg").err,
            "gearlash: --plot = size=a.svg: must be distribution=FILE, yield=FILE or "
            "indices=FILE\n");
}

TEST(ToleranceCommand, OfAnyDriveSaysHowManyHunt) {
  const Outcome text = run_tool({"tolerance", "examples/first-servo.toml", "--set",
                                 "gearbox.backlash=6 arcmin ± 20 %", "--samples", "32"});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out,
              HasSubstr("hunt                                 all 32, so at least 90.62 %"));
  EXPECT_THAT(text.out, HasSubstr("amplitude of the motor, mean of all"));
  EXPECT_THAT(text.out, HasSubstr("gearbox.backlash  ± 20 %"));
  EXPECT_THAT(text.out, HasSubstr("were tried, "));
}

TEST(EdgeToleranceCommand, FaultsAreToldAtOnce) {
  const Outcome run =
      run_tool({"tolerance", "examples/toleranced.toml", "--samples", "1e6", "--seed", "-1",
                "--target", "size <= 1 kg", "--yield", "110 %", "--format", "xml"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(lines_of(run.err),
              ElementsAre("gearlash: --format = xml: must be text or json",
                          StartsWith("gearlash: --samples = 1e6: must be a whole number from 32"),
                          StartsWith("gearlash: --seed = -1: must be a whole number from 0"),
                          StartsWith("gearlash: --target = size <= 1 kg: must be"),
                          StartsWith("gearlash: --yield = 110")));
  const Outcome none = run_tool({"tolerance", "examples/elinco-fd162.toml"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("must have a number with a tolerance"));
  const Outcome no_target = run_tool({"tolerance", "examples/toleranced.toml", "--yield", "0.9"});
  EXPECT_THAT(no_target.err, HasSubstr("--target is missing"));
}

}  // namespace
}  // namespace gearlash::tolerance_command_test
