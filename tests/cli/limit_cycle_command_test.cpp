// gearlash limit-cycle: what it prints is what the library finds.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/range_check.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"
#include "gearlash/version.hpp"
#include "input/servo_of_file.hpp"
#include "tool.hpp"

namespace gearlash::limit_cycle_command_test {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run_shell;
using test::run_tool;
using test::with_sample_servo;
using testing::HasSubstr;
using testing::StartsWith;

json parsed(const Outcome& run) {
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return json::parse(run.out);
}

void expect_same_cycle(const json& printed, const LimitCycle& cycle) {
  EXPECT_EQ(printed["kind"], name_of(cycle.kind));
  EXPECT_EQ(printed["stability"], cycle.stable ? "stable" : "unstable");
  EXPECT_EQ(printed["amplitude"].get<double>(), cycle.amplitude);
  EXPECT_EQ(printed["motor_amplitude"].get<double>(), cycle.motor_amplitude);
  EXPECT_EQ(printed["period"].get<double>(), cycle.period);
  EXPECT_EQ(printed["multiplier"].get<double>(), cycle.multiplier);
  EXPECT_EQ(printed["impact_speed"].get<double>(), cycle.impact_speed);
  EXPECT_EQ(printed["engaged_time"].get<double>(), cycle.engaged_time);
  EXPECT_EQ(printed["separated_time"].get<double>(), cycle.separated_time);
  EXPECT_EQ(printed["residual"].get<double>(), cycle.residual);
  EXPECT_EQ(printed["events_per_period"].get<std::size_t>(), cycle.impacts_per_period);
  EXPECT_EQ(printed["settles"], cycle.settles);
  EXPECT_EQ(printed["energy"]["impacts"].get<double>(), cycle.energy.impacts);
  EXPECT_EQ(printed["energy"]["total"].get<double>(), cycle.energy.lost());
}

TEST(LimitCycleCommand, JsonReadsBackAsExactlyWhatTheLibraryFinds) {
  const json printed = parsed(run_tool(with_sample_servo({"limit-cycle", "--format", "json"})));
  const NormalizedServo servo{
      .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);

  EXPECT_EQ(printed["normal_form"]["damping"].get<double>(), 0.19);
  EXPECT_EQ(printed["normal_form"]["inertia_ratio"].get<double>(), 2.0);
  EXPECT_EQ(printed["normal_form"]["friction_ratio"].get<double>(), 0.1);
  EXPECT_EQ(printed["normal_form"]["backlash"].get<double>(), 0.3);
  EXPECT_EQ(printed["normal_form"]["restitution"].get<double>(), 0.0);
  EXPECT_EQ(printed["drive"]["sensor.position"], "load");
  EXPECT_EQ(printed["growth_at_rest"].get<double>(), analysis.growth_at_rest);
  EXPECT_EQ(printed["verdict"], "hunts");
  EXPECT_EQ(printed["schema"], "gearlash/limit-cycle/2");
  EXPECT_EQ(printed["engine"], "closed form");
  ASSERT_EQ(printed["cycles"].size(), analysis.cycles.size());
  for (std::size_t i = 0; i < analysis.cycles.size(); ++i) {
    expect_same_cycle(printed["cycles"][i], analysis.cycles[i]);
  }
  EXPECT_EQ(printed["version"], version);
  EXPECT_THAT(printed["command"].get<std::string>(),
              StartsWith("gearlash limit-cycle --format json --damping 0.19"));
  // Published numbers, so that a fault shared with the library would be seen.
  EXPECT_NEAR(printed["cycles"][0]["amplitude"].get<double>(), 0.241611108, 1e-9);
  EXPECT_NEAR(printed["cycles"][0]["period"].get<double>(), 6.456205, 1e-6);
}

TEST(LimitCycleCommand, BoundsAreProvedAndHoldWhatIsComputed) {
  const json printed = parsed(run_tool(with_sample_servo({"limit-cycle", "--format", "json"})));
  for (const char* statement : {"verdict", "stability", "completeness"}) {
    EXPECT_EQ(printed["certainty"][statement], "enclosed");
  }
  const auto expect_within = [](const json& range, double value) {
    EXPECT_LE(range[0].get<double>(), value);
    EXPECT_GE(range[1].get<double>(), value);
    EXPECT_LT(range[1].get<double>() - range[0].get<double>(), 1e-12 * value);
  };
  const json& cycle = printed["cycles"][0];
  expect_within(printed["bounds"]["growth_at_rest"], printed["growth_at_rest"]);
  expect_within(printed["bounds"]["amplitude"], cycle["amplitude"]);
  expect_within(printed["bounds"]["period"], cycle["period"]);
  expect_within(printed["bounds"]["multiplier"], cycle["multiplier"]);
  const json searched = parsed(
      run_tool(with_sample_servo({"limit-cycle", "--format", "json", "--restitution", "0.3"})));
  EXPECT_EQ(searched["certainty"]["verdict"], "searched");
  EXPECT_EQ(searched["certainty"]["stability"], "computed");
  EXPECT_TRUE(searched["bounds"].is_null());
}

TEST(LimitCycleCommand, WhereTheEnclosureTouchesOneItIsUndecidedAndSaysHowWideItIs) {
  // ζ of the boundary for J_L/J_M = 1, F_L/F = 1/2 (c = D = 2ζ), to the last digit.
  double quiet = 1.0;
  double hunting = 0.3;
  while (true) {
    const double middle = 0.5 * (quiet + hunting);
    if (middle == quiet || middle == hunting) break;
    const NormalizedServo servo{.damping = middle, .backlash = 0.3};
    (growth_at_rest(servo_dynamics(servo)) > 1.0 ? hunting : quiet) = middle;
  }
  const Outcome run = run_tool({"limit-cycle", "--damping", exact_text(hunting), "--inertia-ratio",
                                "1", "--friction-ratio", "0.5", "--backlash", "0.3"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("Its growth at rest is 1 to within "));
  EXPECT_THAT(run.out, HasSubstr("e-1"));
  EXPECT_THAT(run.err, HasSubstr("undecided"));
}

TEST(LimitCycleCommand, EnergyProvesWhatNoSearchCan) {
  const std::vector<std::string> servo = {
      "limit-cycle", "--damping",  "1.2", "--inertia-ratio", "1", "--friction-ratio",
      "0.5",         "--backlash", "0.3", "--restitution",   "1"};
  const Outcome text = run_tool(servo);
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out, HasSubstr("The servo cannot hunt with any"));
  EXPECT_THAT(text.out, HasSubstr("This is proved."));
  std::vector<std::string> as_json = servo;
  as_json.insert(as_json.end(), {"--format", "json"});
  const json printed = parsed(run_tool(as_json));
  EXPECT_EQ(printed["dissipative"], true);
  EXPECT_EQ(printed["certainty"]["verdict"], "theorem");
}

TEST(LimitCycleCommand, PrintsWhatIsKnownAtItsTimeLimit) {
  const Outcome run = run_tool(
      {"limit-cycle", "examples/robot-joint.toml", "--format", "json", "--time-limit", "1 ms"});
  EXPECT_EQ(run.status, 1) << run.err;
  const json answer = json::parse(run.out);
  EXPECT_FALSE(answer["search"]["complete"].get<bool>());
  EXPECT_THAT(run.err, HasSubstr("stopped early"));
  EXPECT_LT(answer["search"]["starts"].size(), 10U);
}

TEST(LimitCycleCommand, RefusesATimeLimitThatIsNone) {
  const Outcome run =
      run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--time-limit", "0 s"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--time-limit = 0 s: must be positive, in s"));
}

/// The search takes some 130 MB if it may.
TEST(LimitCycleCommand, KeepsItsMemoryLimit) {
  if (!test::may_limit_memory) GTEST_SKIP() << "sanitizers reserve more addresses than permitted";
  const std::string search =
      "ulimit -v 130000; \"$GEARLASH\" limit-cycle "
      "tests/regression/data/continuous/slides-for-hours.toml --brief";
  EXPECT_EQ(run_shell(search).status, 3);
  const Outcome limited = run_shell(search + " --memory-limit '100 MB'");
  EXPECT_EQ(limited.status, 0) << limited.err;
  EXPECT_THAT(limited.out, HasSubstr("comes to rest"));
}

/// Linux counts a parent's memory in the peak that getrusage() gives of its child.
TEST(LimitCycleCommand, CountsNoMemoryOfTheProgramThatStartsIt) {
  if (!test::may_limit_memory) GTEST_SKIP() << "sanitizers take more memory than permitted";
  const Outcome run = run_shell(
      "GEARLASH=\"$GEARLASH\" python3 -c \"import os, subprocess; taken = b'1' * 200_000_000; "
      "subprocess.run([os.environ['GEARLASH'], 'limit-cycle', 'examples/robot-joint.toml', "
      "'--brief', '--memory-limit', '150 MB'], check=True)\"");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("undecided")));
}

TEST(LimitCycleCommand, RefusesAMemoryLimitThatIsNone) {
  for (const std::string size : {"much", "-1 GB", "99 MB", "0"}) {
    const Outcome run =
        run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--memory-limit", size});
    EXPECT_EQ(run.status, 2) << size;
    EXPECT_THAT(run.err, HasSubstr("must be a size of at least 100 MB")) << run.err;
  }
}

TEST(LimitCycleCommand, BouncingContactHasItsCyclesInJsonToo) {
  const json printed = parsed(
      run_tool(with_sample_servo({"limit-cycle", "--format", "json", "--restitution", "0.3"})));
  EXPECT_EQ(printed["certainty"]["verdict"], "searched");
  ASSERT_FALSE(printed["cycles"].empty());
  EXPECT_NEAR(printed["cycles"][0]["amplitude"].get<double>(), 0.2401, 5e-5);
}

TEST(LimitCycleCommand, PhysicalNumbersAreThoseOfTheDataSheet) {
  const json printed =
      parsed(run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--format", "json"}));
  const ServoOfFile file =
      read_servo(std::string(GEARLASH_SOURCE_DIRECTORY) + "/examples/elinco-fd162.toml");
  const LimitCycle cycle = analyse_limit_cycles(file.servo).cycles.at(0);
  const json& physical = printed["cycles"][0];
  const json& form = printed["normal_form"];
  EXPECT_NEAR(physical["amplitude"].get<double>() / cycle.amplitude, 1.0, 1e-14);
  EXPECT_NEAR(physical["period"].get<double>() / (cycle.period / *file.natural_frequency), 1.0,
              1e-14);
  EXPECT_EQ(physical["frequency"].get<double>(), 1.0 / physical["period"].get<double>());
  EXPECT_NEAR(form["natural_frequency"].get<double>() / *file.natural_frequency, 1.0, 1e-15);
  EXPECT_NEAR(form["stiffness"].get<double>() / file.drivetrain->stiffness, 1.0, 1e-15);
  EXPECT_NEAR(physical["energy"]["impacts"].get<double>() /
                  (cycle.energy.impacts * file.drivetrain->stiffness),
              1.0, 1e-13);
}

TEST(LimitCycleCommand, NaturalFrequencyWithoutDataSheetGivesSecondsButNoJoules) {
  const json printed =
      parsed(run_tool({"limit-cycle", "examples/normalized.toml", "--format", "json"}));
  EXPECT_EQ(printed["normal_form"]["natural_frequency"].get<double>(), 14.5);
  EXPECT_TRUE(printed["cycles"][0]["energy"].is_null());
  EXPECT_TRUE(printed["normal_form"]["stiffness"].is_null());
}

TEST(LimitCycleCommand, InfinityIsTextBecauseJsonHasNone) {
  const json massless_motor =
      parsed(run_tool({"limit-cycle", "--damping", "0.3", "--inertia-ratio", "inf",
                       "--friction-ratio", "0.5", "--backlash", "0.1", "--format", "json"}));
  EXPECT_EQ(massless_motor["normal_form"]["inertia_ratio"], "inf");
  const json frictionless_load =
      parsed(run_tool({"limit-cycle", "--damping", "0.3", "--inertia-ratio", "1",
                       "--friction-ratio", "0", "--backlash", "0.1", "--format", "json"}));
  EXPECT_EQ(frictionless_load["growth_at_rest"], "inf");
}

TEST(LimitCycleCommand, TextBeginsWithTheVerdict) {
  EXPECT_THAT(run_tool({"limit-cycle", "examples/elinco-fd162.toml"}).out,
              StartsWith("hunts: ±0.0819 rad (4.69°) at 2.26 Hz\n"));
  EXPECT_THAT(run_tool(with_sample_servo({"limit-cycle"})).out,
              StartsWith("hunts: ±0.242 rad (13.8°), period 6.456 / ω_n\n"));
  EXPECT_THAT(run_tool({"limit-cycle", "examples/antenna-field-controlled.toml"}).out,
              StartsWith("cannot hunt: growth at rest 0.422 < 1\n"));
}

TEST(LimitCycleCommand, SizeIsToldInTheUnitOfTheBacklash) {
  EXPECT_THAT(
      run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--backlash", "12 arcmin"}).out,
      StartsWith("hunts: ±9.83 arcmin (0.00286 rad) at 2.26 Hz\n"));
}

TEST(LimitCycleCommand, DegenerateServosHaveAnAnswer) {
  const auto verdict = [](const char* damping, const char* backlash) {
    const Outcome run = run_tool({"limit-cycle", "--damping", damping, "--inertia-ratio", "1",
                                  "--friction-ratio", "0.5", "--backlash", backlash});
    EXPECT_EQ(run.status, 0);
    return run.out;
  };
  EXPECT_THAT(verdict("0", "0.1"), StartsWith("grows without bound"));
  EXPECT_THAT(verdict("0", "0"), StartsWith("undamped"));
  EXPECT_THAT(verdict("0.5", "0"), StartsWith("cannot hunt: no backlash\n"));
  EXPECT_THAT(verdict("100", "0.1"), StartsWith("cannot hunt: growth at rest 0 < 1\n"));
}

TEST(LimitCycleCommand, UnstableCyclesAreTheFootnoteOfTheStableOnes) {
  const Outcome run = run_tool(with_sample_servo({"limit-cycle", "--restitution", "0.6"}));
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, StartsWith("hunts: ±0.217 rad"));
  EXPECT_THAT(run.out,
              HasSubstr("\nUnstable limit cycles, on which no motion stays\n  symmetric "));
}

TEST(LimitCycleCommand, TextHasNoEscapesWhereItIsNoTerminal) {
  EXPECT_THAT(run_tool({"limit-cycle", "examples/elinco-fd162.toml"}).out,
              testing::Not(HasSubstr("\x1b")));
}

TEST(LimitCycleCommand, StatesTheWidestBacklashThatMeetsASpecification) {
  const auto answer = parsed(run_tool(
      with_sample_servo({"limit-cycle", "--specification", "0.1 rad", "--format", "json"})));
  EXPECT_EQ(answer["specification"]["amplitude"], 0.1);
  EXPECT_EQ(answer["specification"]["is_met"], false);
  const double widest = answer["specification"]["widest_backlash"];
  EXPECT_NEAR(widest, 0.1 / 0.8542, 1e-4);
  const auto met =
      parsed(run_tool({"limit-cycle", "--damping", "0.19", "--inertia-ratio", "2",
                       "--friction-ratio", "0.1", "--backlash", std::to_string(0.999 * widest),
                       "--specification", "0.1 rad", "--format", "json"}));
  EXPECT_EQ(met["specification"]["is_met"], true);
  EXPECT_TRUE(
      parsed(run_tool(with_sample_servo({"limit-cycle", "--format", "json"})))["specification"]
          .is_null());
  const Outcome text = run_tool(with_sample_servo({"limit-cycle", "--specification", "0.1 rad"}));
  EXPECT_THAT(text.out, HasSubstr("every backlash up to 0.117 rad"));
  const Outcome bad = run_tool(with_sample_servo({"limit-cycle", "--specification", "0 rad"}));
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("--specification"));
}

TEST(LimitCycleCommand, ComparesMeasuredHuntingWithWhatItFinds) {
  const auto of_period = parsed(run_tool(
      with_sample_servo({"limit-cycle", "--measured", "0.25 rad, 6.5 s", "--format", "json"})));
  const json& measured = of_period["measured"];
  EXPECT_EQ(measured["amplitude"], 0.25);
  ASSERT_EQ(measured["motions"].size(), 1U);
  EXPECT_EQ(measured["motions"][0]["list"], "cycles");
  EXPECT_NEAR(measured["motions"][0]["amplitude_share"], 0.25 / 0.241611108 - 1.0, 1e-8);
  EXPECT_NEAR(measured["motions"][0]["frequency_share"], 6.456205 / 6.5 - 1.0, 1e-6);
  const auto of_frequency = parsed(run_tool(
      with_sample_servo({"limit-cycle", "--measured", "12 deg, 0.2 Hz", "--format", "json"})));
  EXPECT_NEAR(of_frequency["measured"]["frequency"], 0.2, 1e-15);
  EXPECT_TRUE(parsed(run_tool(with_sample_servo({"limit-cycle", "--format", "json"})))["measured"]
                  .is_null());
  const Outcome text =
      run_tool(with_sample_servo({"limit-cycle", "--measured", "0.25 rad, 6.5 s"}));
  EXPECT_THAT(text.out, HasSubstr("amplitude +3.47 %, frequency -0.674 %"));
  for (const char* bad : {"0.25 rad", "0.25 rad, 3 kg", "-1 rad, 1 Hz", "1 rad, 0 Hz"}) {
    const Outcome refused = run_tool(with_sample_servo({"limit-cycle", "--measured", bad}));
    EXPECT_EQ(refused.status, 2) << bad;
    EXPECT_THAT(refused.err, HasSubstr("--measured")) << bad;
  }
}

TEST(LimitCycleCommand, ReportsMarginsOnRequestAndSaysHow) {
  const auto answer_of = [](const std::string& inertia_ratio, bool wants_margins) {
    std::vector<std::string> arguments = {
        "limit-cycle", "--damping",  "0.3", "--inertia-ratio", inertia_ratio, "--friction-ratio",
        "0.4",         "--backlash", "0.3", "--restitution",   "0.3",         "--format",
        "json"};
    if (wants_margins) arguments.emplace_back("--margins");
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out);
  };
  EXPECT_TRUE(answer_of("2", false)["margin"].is_null());
  for (const char* massless : {"0", "inf"}) {
    EXPECT_TRUE(answer_of(massless, false)["margin"].is_null());
    const auto margin = answer_of(massless, true)["margin"];
    EXPECT_EQ(margin["parameters"].size(), 9U);
    for (const auto& one : margin["parameters"]) EXPECT_EQ(one["certified"], true);
    EXPECT_TRUE(margin["overall"].is_object());
  }
  const auto offers = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"limit-cycle", "examples/elinco-fd162.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string text = run_tool(arguments).out;
    const std::size_t place = text.find("Not shown: ");
    return place == std::string::npos ? std::string() : text.substr(place);
  };
  EXPECT_THAT(offers({}), AllOf(HasSubstr("--margins"), HasSubstr("--sensitivities")));
  EXPECT_THAT(offers({"--margins"}), testing::Not(HasSubstr("--margins")));
  EXPECT_EQ(offers({"--margins", "--sensitivities"}), "");
}

TEST(LimitCycleCommand, TellsHowFarHuntingIsAndWhatItDependsOn) {
  const test::Scratch scratch;
  const Outcome run =
      run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--sensitivities", "--margins",
                "--format", "json", "--plot", "tornado=" + (scratch / "tornado.svg").string()});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto answer = nlohmann::json::parse(run.out);
  EXPECT_EQ(answer["margin"]["parameters"].size(), 8U);
  EXPECT_GT(answer["margin"]["overall"]["distance"], 1.0);
  EXPECT_EQ(answer["sensitivities"]["available"], true);
  for (const auto& number : answer["sensitivities"]["numbers"]) {
    if (number["parameter"] != "gearbox.backlash") continue;
    EXPECT_EQ(number["amplitude"]["elasticity"], 1.0);
    EXPECT_EQ(number["period"]["elasticity"], 0.0);
  }
  EXPECT_THAT(test::file_text(scratch / "tornado.svg"), testing::HasSubstr("motor.inertia"));
  const Outcome text = run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--margins"});
  EXPECT_THAT(text.out, testing::HasSubstr("Where hunting ends, one parameter at a time\n"));
  EXPECT_THAT(text.out, testing::HasSubstr("Smallest combined change that stops the "));
}

TEST(LimitCycleCommand, TellsHowFarHuntingIsOverParametersThatAreNamed) {
  const std::vector<std::string> named = {
      "load.inertia", "motor.friction=1e-6:1e-3 N m s/rad:7:log", "sensor.position"};
  std::vector<std::string> asked = {"limit-cycle", "examples/elinco-fd162.toml", "--margins",
                                    "--parameters"};
  asked.push_back(named[0] + "," + named[1] + "," + named[2]);
  const Outcome text = run_tool(asked);
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("Where it comes to rest"), HasSubstr("\n  load.inertia "),
                    HasSubstr("\n  sensor.position "), HasSubstr("Searched, not proved")));
  asked.insert(asked.end(), {"--format", "json"});
  const auto margin = nlohmann::json::parse(run_tool(asked).out)["margin"];
  ASSERT_EQ(margin["parameters"].size(), 3U);
  EXPECT_EQ(margin["parameters"][1]["grid"].size(), 8U);  // and the present one
  EXPECT_TRUE(margin["overall"].is_null());
  asked.erase(asked.begin() + 2);
  EXPECT_THAT(run_tool(asked).err, HasSubstr("--parameters = load.inertia: must come with"));
}

TEST(LimitCycleCommand, TellsHowFarHuntingIsOfADriveThatIsSearched) {
  const std::vector<std::string> asked = {
      "limit-cycle", "examples/symptoms/joint.toml", "--margins", "--parameters",
      "gearbox.backlash=10 arcmin:100 arcmin:3,controller.proportional=200:2000:4"};
  const Outcome text = run_tool(asked);
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("Where it begins to hunt or to run away, one parameter at a time\n"),
                    HasSubstr("\n  controller.proportional  200 N m/rad "),
                    HasSubstr("Smallest combined change found: gearbox.backlash +"),
                    HasSubstr("Searched, not proved")));
  const auto margin_of = [&](const std::vector<std::string>& more, int status) {
    std::vector<std::string> arguments = asked;
    arguments.insert(arguments.end(), {"--format", "json"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.status, status) << run.err;
    return nlohmann::json::parse(run.out)["margin"];
  };
  const auto margin = margin_of({}, 0);
  EXPECT_EQ(margin["hunts"], false);
  EXPECT_EQ(margin["stopped"], false);
  EXPECT_TRUE(margin["overall"].is_null());
  ASSERT_EQ(margin["parameters"].size(), 2U);
  const auto& gain = margin["parameters"][1];
  EXPECT_EQ(gain["certified"], false);
  EXPECT_TRUE(gain["below"].is_null());
  const double alone = gain["above"].get<double>() / gain["present"].get<double>();
  const double together = margin["combined"]["factors"]["controller.proportional"];
  EXPECT_GT(together, 1.0);
  EXPECT_LT(together, alone);
  // Put back: with the last gain it rests, with a little more it hunts.
  const auto verdict_with = [](double value) {
    const Outcome run = run_tool({"limit-cycle", "examples/symptoms/joint.toml", "--brief", "--set",
                                  "controller.proportional=" + std::to_string(value) + " N m/rad"});
    return run.out;
  };
  EXPECT_THAT(verdict_with(gain["above"]), HasSubstr("comes to rest"));
  EXPECT_THAT(verdict_with(1.001 * gain["above"].get<double>()), HasSubstr("hunts"));
  // A limit stops the margins too.
  EXPECT_EQ(margin_of({"--time-limit", "100 ms"}, 1)["stopped"], true);
}

TEST(LimitCycleCommand, AnswersAtTheEndsOfTheRanges) {
  for (const auto& [damping, inertia_ratio] :
       {std::pair("1000", "1e9"), std::pair("1000", "1e-9"), std::pair("1e-15", "1"),
        std::pair("0.5", "inf"), std::pair("0.5", "0"), std::pair("0", "1")}) {
    const Outcome run =
        run_tool({"limit-cycle", "--damping", damping, "--inertia-ratio", inertia_ratio,
                  "--friction-ratio", "0.5", "--backlash", "0.1", "--sensitivities", "--margins"});
    EXPECT_EQ(run.status, 0) << damping << " " << inertia_ratio << " " << run.err;
  }
}

}  // namespace
}  // namespace gearlash::limit_cycle_command_test
