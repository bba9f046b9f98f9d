// compare puts drives, or the values of one parameter, side by side, each as limit-cycle answers.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>

#include "tool.hpp"

namespace gearlash::compare_command_test {
namespace {

using nlohmann::json;
using test::file_text;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

Words joined(Words first, const Words& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

json compared(const Words& words) {
  const Outcome run = run_tool(joined(joined({"compare"}, words), {"--format", "json"}));
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out);
}

Words names_of(const json& printed) {
  Words names;
  for (const json& one : printed["drives"]) names.push_back(one["name"]);
  return names;
}

/// Each case is what limit-cycle answers with the words of that drive alone.
void expect_those_of_limit_cycle(const Words& words, const std::vector<Words>& alone) {
  const json printed = compared(words);
  const Outcome brief = run_tool(joined(joined({"compare"}, words), {"--brief"}));
  const Words headlines = test::lines_of(brief.out);
  ASSERT_EQ(printed["drives"].size(), alone.size());
  ASSERT_EQ(headlines.size(), alone.size()) << brief.out;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const Words command = joined({"limit-cycle"}, alone[i]);
    SCOPED_TRACE(testing::PrintToString(command));
    const json expected = json::parse(run_tool(joined(command, {"--format", "json"})).out);
    const std::set<std::string> besides = {"loop", "step", "values"};  // compare asks for them
    for (const auto& [key, found] : printed["drives"][i]["answer"].items()) {
      if (besides.contains(key)) continue;
      EXPECT_EQ(found, expected[key]) << key;
    }
    EXPECT_EQ(printed["drives"][i]["drive"], expected["drive"]);
    const std::string headline = run_tool(joined(command, {"--brief"})).out;
    EXPECT_THAT(headlines[i] + "\n", testing::EndsWith("  " + headline));
    EXPECT_THAT(headlines[i], HasSubstr(printed["drives"][i]["name"].get<std::string>()));
  }
}

constexpr char servo[] = "examples/elinco-fd162.toml";
const Words form = {"--damping",        "0.19", "--inertia-ratio", "2",
                    "--friction-ratio", "0.1",  "--backlash",      "0.3"};

// ---- as limit-cycle answers ---------------------------------------------------------------------

/// The question of 0.2 that was answered "comes to rest, by a search".
TEST(RegressionCompareCommand, ProvesWhatLimitCycleProves) {
  const Words proved = {servo, "--set", "load.friction=0.001 N m s/rad"};
  expect_those_of_limit_cycle(
      proved, {joined(proved, {"--sensor", "load"}), joined(proved, {"--sensor", "motor"}),
               joined(proved, {"--sensor", "both"})});
  const json printed = compared(proved);
  for (const json& one : printed["drives"]) {
    EXPECT_EQ(one["answer"]["verdict"], "cannot hunt") << one["name"];
    EXPECT_THAT(one["answer"]["certainty"].get<std::string>(),
                testing::AnyOf("enclosed", "theorem"))
        << one["name"];
  }
}

TEST(RegressionCompareCommand, TakesTheNormalForm) {
  expect_those_of_limit_cycle(
      form, {joined(form, {"--sensor", "load"}), joined(form, {"--sensor", "motor"}),
             joined(form, {"--sensor", "both"})});
  const Words bounces = joined(form, {"--x", "restitution=0:0.6:3"});
  expect_those_of_limit_cycle(
      bounces, {joined(form, {"--restitution", "0"}), joined(form, {"--restitution", "0.3"}),
                joined(form, {"--restitution", "0.6"})});
  const std::string text = run_tool(joined({"compare"}, bounces)).out;
  EXPECT_THAT(text, HasSubstr("frequency (ω_n)"));
  EXPECT_THAT(text, HasSubstr("settling time (1/ω_n)"));
}

/// A number that only the normal form has, of a data sheet, and its option left out.
TEST(CompareCommand, TakesAnAxisOfTheNormalForm) {
  EXPECT_THAT(names_of(compared({servo, "--x", "damping=0.1,0.9"})), ElementsAre("0.1", "0.9"));
  const Words without = {"--inertia-ratio", "2",   "--friction-ratio", "0.1", "--backlash",
                         "12 arcmin",       "--x", "damping=0.19,0.9"};
  EXPECT_EQ(compared(without)["drives"][1]["answer"]["verdict"], "cannot hunt");
}

TEST(CompareCommand, TakesAnAxisOfWordsAndOfNumbers) {
  expect_those_of_limit_cycle({"examples/telescope-axis.toml", "--x", "controller.kind=PD,PID"},
                              {{"examples/telescope-axis.toml", "--set", "controller.kind=PD"},
                               {"examples/telescope-axis.toml", "--set", "controller.kind=PID"}});
  const Words gap = {servo, "--x", "gearbox.backlash=0.05:0.15:3"};
  expect_those_of_limit_cycle(gap, {{servo, "--set", "gearbox.backlash=0.05 rad"},
                                    {servo, "--set", "gearbox.backlash=0.1 rad"},
                                    {servo, "--set", "gearbox.backlash=0.15 rad"}});
  const json printed = compared(gap);
  EXPECT_THAT(names_of(printed), ElementsAre("0.05 rad", "0.1 rad", "0.15 rad"));
  EXPECT_EQ(printed["axis"]["path"], "gearbox.backlash");
  EXPECT_EQ(printed["axis"]["values"][2], 0.15);
  // All make the step of the first.
  EXPECT_EQ(printed["drives"][2]["answer"]["step"]["step"], std::numbers::pi / 180.0);
}

TEST(CompareCommand, PutsFilesSideBySide) {
  const Words files = {servo, "examples/dynamixel-joint.toml"};
  expect_those_of_limit_cycle(files, {{files[0]}, {files[1]}});
  EXPECT_THAT(names_of(compared(files)), ElementsAre("elinco-fd162", "dynamixel-joint"));
  EXPECT_TRUE(compared(files)["axis"].is_null());
  const Words changed = joined(files, {"--set", "gearbox.backlash=0.01 rad", "--sensor", "motor"});
  const json printed = compared(changed);
  for (const json& one : printed["drives"]) {
    EXPECT_EQ(one["drive"]["gearbox.backlash"], 0.01) << one["name"];
    EXPECT_EQ(one["drive"]["sensor.position"], "motor") << one["name"];
  }
}

/// Two files with one stem have the names as typed; standard input is one of several.
TEST(CompareCommand, NamesFilesApart) {
  const Scratch scratch;
  const std::string copy = (scratch / "elinco-fd162.toml").string();
  test::run_shell(std::string("cp ") + servo + " " + test::quoted(copy));
  EXPECT_THAT(names_of(compared({servo, copy})), ElementsAre(servo, copy));
  const Outcome piped = test::run_shell(std::string("\"$GEARLASH\" compare - ") + servo +
                                        " --brief <" + test::quoted(copy));
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_THAT(test::lines_of(piped.out),
              ElementsAre(HasSubstr("-  "), testing::StartsWith("  elinco-fd162  ")));
}

// ---- what it shows ------------------------------------------------------------------------------

TEST(CompareCommand, ShowsTheQuantitiesThatAreAskedFor) {
  const Words asked = {servo, "--quantities", "multiplier,static-error,multiplier,verdict"};
  const std::string text = run_tool(joined({"compare"}, asked)).out;
  EXPECT_THAT(text, HasSubstr("\n  multiplier "));
  EXPECT_THAT(text, HasSubstr("\n  static error (rad) "));
  EXPECT_THAT(text, Not(HasSubstr("bandwidth")));
  const json printed = compared(asked);
  EXPECT_EQ(printed["quantities"], json({"multiplier", "static_error", "verdict"}));
  const json values = printed["drives"][1]["answer"]["values"];
  EXPECT_EQ(printed["drives"][1]["answer"]["verdict"], "cannot hunt");
  EXPECT_NEAR(values["static_error"].get<double>(), 0.05, 1e-12);
  EXPECT_TRUE(values["multiplier"].is_null());
}

/// The newcomer's arm: with the encoder on the load the registers are an eighth, and that loop is
/// not stable. 0.2 reported an overshoot of 2755 %.
TEST(RegressionCompareCommand, StatesThatRegistersAreRescaledAndALoopIsNotStable) {
  const Scratch scratch;
  const std::string arm = (scratch / "arm.toml").string();
  std::ofstream(arm) << R"([motor]
kind = "torque-controlled"
inertia = "0.0001 kg m2"
friction = 0
coulomb = "30 mN m"
[gearbox]
ratio = 8
backlash = "3 deg"
[load]
inertia = "0.2 kg m2"
friction = "0.02 N m s/rad"
gravity = "8 N m"
[sensor]
position = "motor"
[controller]
kind = "odrive"
pos_gain = 20
vel_gain = 0.16
vel_integrator_gain = 0.32
)";
  const Words words = {arm, "--sensor", "motor,load"};
  std::string text = run_tool(joined({"compare"}, words)).out;
  std::replace(text.begin(), text.end(), '\n', ' ');
  EXPECT_THAT(text, HasSubstr("Not stable even without the gap: load."));
  EXPECT_THAT(text, HasSubstr("changes the loop stiffness from that with motor: load ×0.125."));
  const json load = compared(words)["drives"][1];
  EXPECT_EQ(load["answer"]["loop"]["is_stable"], false);
  EXPECT_TRUE(load["answer"]["step"].is_null());
  EXPECT_TRUE(load["answer"]["values"]["overshoot"].is_null());
}

/// Behind the gap the axis hunts; before it, the motor stands at the reference and the load
/// anywhere in the gap.
TEST(CompareCommand, ThatTheEncoderOnTheMotorEndsTheHuntingOfTheAxis) {
  const json printed = compared({"examples/telescope-axis.toml", "--sensor", "load,motor"});
  EXPECT_EQ(printed["drives"][0]["answer"]["verdict"], "hunts");
  EXPECT_EQ(printed["drives"][1]["answer"]["verdict"], "comes to rest");
  const double half_gap = 5.0 / 60.0 * std::acos(-1.0) / 180.0;
  const json& error = printed["drives"][1]["answer"]["rest"]["error"];
  EXPECT_NEAR(error["high"].get<double>(), half_gap, 1e-3 * half_gap);
  EXPECT_EQ(error["low"].get<double>(), -error["high"].get<double>());
  // A step leaves it on one of the faces.
  EXPECT_NEAR(printed["drives"][1]["answer"]["step"]["final_error"].get<double>(), half_gap,
              1e-3 * half_gap);
  EXPECT_NEAR(printed["drives"][0]["answer"]["step"]["final_error"].get<double>(), 0.0,
              1e-6 * half_gap);
}

/// Every case has a verdict, from decided starts alone, and a step response to its end.
void expect_answers(const json& printed) {
  ASSERT_THAT(names_of(printed), ElementsAre("load", "motor", "both"));
  for (const json& one : printed["drives"]) {
    SCOPED_TRACE(one["name"]);
    EXPECT_NE(one["answer"]["verdict"], "undecided");
    const json& search = one["answer"]["search"];
    if (search.is_null()) continue;
    for (const json& start : search["starts"]) EXPECT_NE(start["end"], "undecided") << start;
    EXPECT_EQ(one["answer"]["loop"]["is_stable"], true);
    const json& response = one["answer"]["step"];
    EXPECT_GT(response["until"].get<double>(), 0.0);
    for (const std::string key : {"final_error", "ripple", "overshoot"}) {
      EXPECT_TRUE(response[key].is_number()) << key;
    }
  }
}

/// Of a joint whose registers are a firmware's.
TEST(CompareCommand, AnswersBeforeAndAfterTheGap) {
  const json printed = compared({"examples/dynamixel-joint.toml"});
  expect_answers(printed);
  const auto step = [&](std::size_t i) {
    return printed["drives"][i]["encoder_step"].get<double>();
  };
  const double ratio = printed["drives"][0]["drive"]["gearbox.ratio"];
  EXPECT_NEAR(step(0), ratio * step(1), 1e-12 * step(0));
}

/// The same axis with faces that give way: without a gap it is a drive with joined shafts.
TEST(CompareCommand, AnswersWithTheGapAndWithoutIt) {
  const auto with_backlash = [](const std::string& backlash) {
    return compared({"examples/telescope-axis.toml", "--step", "10 arcmin", "--set",
                     "contact.stiffness=44 N m/arcmin", "--set", "contact.damping=80 N m s/rad",
                     "--set", "gearbox.backlash=" + backlash});
  };
  const json with = with_backlash("10 arcmin");
  const json without = with_backlash("0");
  expect_answers(with);
  expect_answers(without);
  EXPECT_EQ(with["drives"][0]["answer"]["verdict"], "hunts");
  for (const json& one : without["drives"]) {
    EXPECT_EQ(one["answer"]["values"]["amplitude"], 0.0) << one["name"];
    EXPECT_TRUE(one["answer"]["step"]["settling_time"].is_number()) << one["name"];
  }
}

/// Many drives take several blocks of columns.
TEST(CompareCommand, KeepsTablesWithinATerminal) {
  const Outcome run = run_tool({"compare", servo, "--x", "gearbox.backlash=0.01:0.2:20"});
  EXPECT_EQ(run.status, 0) << run.err;
  std::size_t headers = 0;
  for (const std::string& line : test::lines_of(run.out)) {
    if (line.find("gearbox.backlash") != std::string::npos) ++headers;
    EXPECT_LE(line.size(), 100U) << line;
  }
  EXPECT_GT(headers, 1U);
}

TEST(CompareCommand, DrawsTheStepsWithTheirNames) {
  const Scratch scratch;
  const std::string picture = (scratch / "a.svg").string();
  const Outcome run = run_tool({"compare", servo, "--plot", "time=" + picture});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string drawn = file_text(picture);
  EXPECT_THAT(drawn, HasSubstr("load: hunts: ±0.0819 rad at 2.26 Hz"));
  EXPECT_THAT(drawn, HasSubstr("motor: cannot hunt"));
  EXPECT_THAT(drawn, HasSubstr("step of 0.01745 rad"));
}

// ---- bad input ----------------------------------------------------------------------------------

/// Values outside the permitted range are left out; none left is a fault.
TEST(RegressionCompareCommand, LeavesOutValuesThatAreNotPermitted) {
  const Words words = {"compare",    "--damping", "0.23", "--inertia-ratio",           "3",
                       "--backlash", "0.2",       "--x",  "friction-ratio=0.5:1.25:4", "--brief"};
  const Outcome run = run_tool(words);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err,
            "gearlash: --x friction-ratio: left out: 1.25 (servo.friction_ratio must be from 0 to "
            "1)\n");
  EXPECT_THAT(test::lines_of(run.out), testing::SizeIs(3));
  const Outcome none = run_tool({"compare", servo, "--x", "friction-ratio=2,3"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("--x = 2 and 1 more: servo.friction_ratio must be from 0 to 1"));
}

TEST(EdgeCompareCommand, ReportsAllFaultsAtOnce) {
  const auto faults_of = [](const Words& words) {
    const Outcome run = run_tool(joined({"compare"}, words));
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(run.out, "");
    return test::lines_of(run.err);
  };
  EXPECT_THAT(
      faults_of({servo, "--x", "gearbox.backlash=1:0:3", "--step", "0", "--until", "-1", "--format",
                 "xml", "--plot", "a.svg", "--quantities", "amplitud,period", "--time-limit", "0",
                 "--set", "gearbox.backlsh=1"}),
      testing::UnorderedElementsAre(
          HasSubstr("--step = 0: must be an angle"), HasSubstr("--until = -1: must be positive"),
          HasSubstr("--format = xml"), HasSubstr("--plot = a.svg"),
          HasSubstr("--quantities = amplitud: must be"), HasSubstr("--time-limit = 0"),
          HasSubstr("did you mean gearbox.backlash?"), HasSubstr("--x = 1 to 0: must rise")));
  EXPECT_THAT(faults_of({servo, "--sensor", "load,load"}), ElementsAre(HasSubstr("--sensor")));
  EXPECT_THAT(faults_of({servo, "--sensor", "moter"}), ElementsAre(HasSubstr("--sensor")));
  EXPECT_THAT(faults_of({servo, "--sensor", "load", "--x", "sensor.position=load,motor"}),
              ElementsAre(HasSubstr("--sensor = load: must be left out: --x varies it")));
  EXPECT_THAT(faults_of({servo, "--x", "gearbox.backlash=0.1:1:200"}),
              ElementsAre(HasSubstr("--x = 200 values: must be at most 100")));
  // A fault of --set is one for all files; each file has its own.
  EXPECT_THAT(faults_of({servo, "none.toml", "examples/robot-joint.toml", "--set", "a.b=1", "--x",
                         "gearbox.ratio=1,2"}),
              ElementsAre(HasSubstr("--x = gearbox.ratio=1,2: must be left out"),
                          HasSubstr("--set = a.b"), HasSubstr("none.toml")));
  EXPECT_THAT(faults_of({"-", "-"}), ElementsAre(HasSubstr("DRIVE.toml = -: must be given once")));
  EXPECT_THAT(faults_of({"--x", "damping=0.1,0.2"}),
              ElementsAre(HasSubstr("--inertia-ratio"), HasSubstr("--friction-ratio")));
  // Values that no single rule forbids, but the drive does.
  EXPECT_THAT(faults_of({"examples/robot-joint.toml", "--x", "motor.breakaway=1 mN m,1.2 mN m"}),
              ElementsAre(HasSubstr("0.001 N m: motor.breakaway"),
                          HasSubstr("0.0012 N m: motor.breakaway")));
}

TEST(CompareCommand, LeavesOutValuesThatTheDriveDoesNotPermit) {
  const Outcome run = run_tool(
      {"compare", "examples/robot-joint.toml", "--x", "gearbox.backlash=0,0.1 deg", "--brief"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, testing::StartsWith("gearlash: --x gearbox.backlash: left out: 0 "
                                           "(gearbox.backlash = 0 rad: must be positive"));
  EXPECT_EQ(test::lines_of(run.out).size(), 1U);
}

}  // namespace
}  // namespace gearlash::compare_command_test
