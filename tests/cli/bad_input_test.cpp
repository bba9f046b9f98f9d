// Bad input ends with exit status 2 and one line for each fault: field, value, what is permitted.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace gearlash::bad_input_test {
namespace {

using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::vector<std::string> faults(const std::vector<std::string>& arguments) {
  const Outcome run = run_tool(arguments);
  EXPECT_EQ(run.status, 2) << run.out << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  return lines_of(run.err);
}

TEST(BadInput, AllMissingOptionsAreListedAtOnce) {
  EXPECT_THAT(faults({"limit-cycle", "--damping", "0.19"}),
              ElementsAre(StartsWith("gearlash: --inertia-ratio is missing: "),
                          StartsWith("gearlash: --friction-ratio is missing: "),
                          StartsWith("gearlash: --backlash is missing: ")));
}

TEST(BadInput, WithoutADriveAFileIsAskedFor) {
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{
           {"limit-cycle"},
           {"simulate"},
           {"describe"},
           {"compare"},
           {"show"},
           {"tune"},
           {"tolerance"},
           {"design", "--target", "no-hunting"},
           {"thesis", "run"},
           {"thesis", "chart-reading"},
           {"chart", "--x", "load.inertia=1:2:2", "--plot", "curves=a.svg"}}) {
    EXPECT_THAT(faults(verb),
                ElementsAre(StartsWith("gearlash: DRIVE.toml is missing: must be a drive's file")));
  }
}

TEST(BadInput, EveryFaultOfTheOptionsIsListed) {
  EXPECT_THAT(faults({"simulate", "--damping", "-1", "--inertia-ratio", "x", "--friction-ratio",
                      "3/2", "--backlash", "12 kg", "--format", "xml", "--plot", "both=a.svg",
                      "--until", "0", "--initial-speed", "inf"}),
              testing::UnorderedElementsAre(
                  "gearlash: --format = xml: must be csv or json",
                  "gearlash: --plot = both=a.svg: must be time=FILE or phase=FILE",
                  StartsWith("gearlash: --inertia-ratio = x: must be"),
                  StartsWith("gearlash: --backlash = 12 kg: must be"),
                  "gearlash: --damping = -1: must be 0 or from 1e-15 to 1000",
                  "gearlash: --friction-ratio = 3/2: must be from 0 to 1",
                  "gearlash: --initial-speed = inf: must be finite",
                  "gearlash: --until = 0: must be positive, in s"));
}

TEST(BadInput, WhatIsTypedIsNeverReadAsAFile) {
  const auto damping = [](const std::string& typed) {
    return faults({"limit-cycle", "--damping", typed, "--inertia-ratio", "1", "--friction-ratio",
                   "0.5", "--backlash", "0.1"});
  };
  for (const std::string typed : {"0'1", "0.1'\nbacklash = '1", "0x1", "true", "[0.1]"}) {
    EXPECT_THAT(damping(typed), ElementsAre(StartsWith("gearlash: --damping = "))) << typed;
  }
}

TEST(BadInput, WithTheSensorOnTheMotorThereIsNoNormalForm) {
  EXPECT_THAT(
      faults({"map", "--x", "damping=0.1:0.2:3", "--y", "friction-ratio=0.1:0.2:3", "--sensor",
              "motor", "--output", "map.csv", "examples/elinco-fd162.toml"}),
      ElementsAre(StartsWith("gearlash: --y = friction-ratio: must be a number or a choice"),
                  StartsWith("gearlash: --x = damping: must be a number or a choice")));
  EXPECT_THAT(faults({"limit-cycle", "examples/elinco-fd162.toml", "--sensor", "gear"}),
              ElementsAre("gearlash: --sensor = gear: must be one of load, motor, both"));
}

TEST(BadInput, ABacklashOfADataSheetHasItsUnit) {
  const std::string sheet = "examples/elinco-fd162.toml";
  EXPECT_THAT(faults({"limit-cycle", sheet, "--backlash", "5"}),
              ElementsAre("gearlash: --backlash = 5: must be an angle with its unit, such as 12 "
                          "arcmin"));
  EXPECT_EQ(run_tool({"limit-cycle", sheet, "--backlash", "5 arcmin"}).status, 0);
  EXPECT_EQ(run_tool({"limit-cycle", "--damping", "0.2", "--inertia-ratio", "1", "--friction-ratio",
                      "0.5", "--backlash", "0.1"})
                .status,
            0);
}

TEST(BadInput, AnOptionAndASettingThatContradictEachOtherAreNamed) {
  EXPECT_THAT(faults({"limit-cycle", "examples/elinco-fd162.toml", "--backlash", "5 arcmin",
                      "--set", "gearbox.backlash=3 arcmin"}),
              ElementsAre("gearlash: --backlash = 5 arcmin: must be left out, or --set "
                          "gearbox.backlash=3 arcmin"));
  EXPECT_THAT(faults({"limit-cycle", "--damping", "0.2", "--inertia-ratio", "1", "--friction-ratio",
                      "0.5", "--backlash", "0.1", "--set", "servo.backlash=0.2"}),
              ElementsAre("gearlash: --backlash = 0.1: must be left out, or --set "
                          "servo.backlash=0.2"));
  EXPECT_THAT(faults({"limit-cycle", "examples/robot-joint.toml", "--set", "controller.Kp=1 V/deg",
                      "--set", "controller.proportional=2 V/deg"}),
              ElementsAre("gearlash: --set = controller.proportional=2 V/deg: must be left out, or "
                          "--set controller.Kp=1 V/deg"));
}

TEST(BadInput, FaultsOfTheFileCarryItsPlaceAndStandBesideThoseOfOptions) {
  const Scratch scratch;
  const std::string path = (scratch / "servo.toml").string();
  std::ofstream(path) << "[servo]\ndamping = -2\ninertia_ratio = 1\nfriction_ratio = 0.5\n"
                         "backlash = \"0.1 rad\"\n";
  EXPECT_THAT(faults({"limit-cycle", path, "--restitution", "2"}),
              testing::UnorderedElementsAre(
                  StartsWith("gearlash: " + path + ":2:11: servo.damping = -2: must be"),
                  "gearlash: --restitution = 2: must be from 0 to 1"));
}

TEST(BadInput, FileThatIsNotThere) {
  EXPECT_THAT(faults({"limit-cycle", "no-such.toml"}), ElementsAre(HasSubstr("no-such.toml")));
  EXPECT_THAT(faults({"motor", "no-such.toml"}), ElementsAre(HasSubstr("no-such.toml")));
}

TEST(BadInput, MotorNeedsADataSheet) {
  EXPECT_THAT(faults({"motor", "examples/normalized.toml"}),
              ElementsAre("gearlash: examples/normalized.toml: motor is missing: the procedure "
                          "starts from a data sheet with [motor]"));
}

TEST(BadInput, UsageFaultsAreOneLine) {
  EXPECT_THAT(faults({}),
              ElementsAre("gearlash: verb is missing: must be limit-cycle, simulate, describe, "
                          "compare, design, tune, tolerance, map, chart, sweep, explore, show, "
                          "motor or thesis; see gearlash --help"));
  EXPECT_THAT(
      faults({"wobble"}),
      ElementsAre("gearlash: verb = wobble: must be limit-cycle, simulate, describe, compare, "
                  "design, tune, tolerance, map, chart, sweep, explore, show, motor or thesis; see "
                  "gearlash --help"));
  EXPECT_THAT(faults({"limit-cycle", "--dampness", "1"}), ElementsAre(HasSubstr("--dampness")));
  EXPECT_THAT(faults({"limit-cycle", "--damping"}), ElementsAre(HasSubstr("--damping")));
  EXPECT_THAT(faults({"limit-cycle", "a.toml", "b.toml"}), ElementsAre(HasSubstr("b.toml")));
  EXPECT_THAT(faults({"motor"}), ElementsAre(HasSubstr("DRIVE.toml")));
  EXPECT_THAT(faults({"limit-cycle", "--format\nx", "1"}), ElementsAre(HasSubstr("\\n")));
}

TEST(BadInput, PictureEndings) {
  EXPECT_THAT(faults({"limit-cycle", "examples/elinco-fd162.toml", "--plot", "phase=a.jpeg"}),
              ElementsAre("gearlash: --plot = a.jpeg: must end in .svg, .png or .pdf"));
  EXPECT_THAT(
      faults({"limit-cycle", "examples/elinco-fd162.toml", "--plot", "a.svg", "--plot",
              "tornada=a.svg"}),
      ElementsAre(
          "gearlash: --plot = a.svg: must be phase=FILE, time=FILE, tornado=FILE or ceiling=FILE",
          "gearlash: --plot = tornada=a.svg: must be phase=FILE, time=FILE, tornado=FILE or "
          "ceiling=FILE (did you mean tornado?)"));
  EXPECT_THAT(faults({"simulate", "examples/elinco-fd162.toml", "--plot", "time="}),
              ElementsAre(HasSubstr("must end in .svg, .png or .pdf")));
}

}  // namespace
}  // namespace gearlash::bad_input_test
