// gearlash limit-cycle: what it prints is what the library finds.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <tuple>

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

json answer_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "limit-cycle");
  arguments.insert(arguments.end(), {"--format", "json"});
  return parsed(run_tool(arguments));
}

json answer_of_sample(const std::vector<std::string>& more = {}) {
  return answer_of(with_sample_servo(more));
}

// ζ = 1, r = 2.75, f = 0.2 lies on the boundary of what energy proves.
TEST(LimitCycleCommand, ALongDecimalIsNotTakenForAShortOne) {
  const std::string rest =
      " --inertia-ratio 2.75 --friction-ratio 0.2 --restitution 0.5 --backlash 1";
  const std::string file =
      "printf '[servo]\\ndamping = %s\\ninertia_ratio = 2.75\\nfriction_ratio = 0.2\\n"
      "backlash = \"1 rad\"\\n[contact]\\nrestitution = 0.5\\n' ";
  const auto text_of = [](const std::string& command) {
    const Outcome run = run_shell(command);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  };
  for (const std::string& way :
       {std::string("\"$GEARLASH\" limit-cycle --damping @") + rest,
        std::string("\"$GEARLASH\" limit-cycle --set servo.damping=@") + rest,
        file + "@ | \"$GEARLASH\" limit-cycle -",
        file + "@ | \"$GEARLASH\" show - | \"$GEARLASH\" limit-cycle -"}) {
    const auto with = [&](const std::string& damping) {
      std::string command = way;
      return text_of(command.replace(command.find('@'), 1, damping));
    };
    EXPECT_THAT(with("1"), HasSubstr("This is proved."));
    EXPECT_THAT(with("0.99999999999999999999"), HasSubstr("it is not proved"));
    EXPECT_THAT(with("0.99999999999999999999"), HasSubstr("were rounded"));
  }
}

TEST(LimitCycleCommand, JsonHasWhatTheLibraryFindsAndHowItWasMade) {
  const json printed = answer_of_sample();
  EXPECT_EQ(printed["schema"], "gearlash/limit-cycle/3");
  EXPECT_EQ(printed["version"], version);
  EXPECT_THAT(printed["command"].get<std::string>(),
              StartsWith("gearlash limit-cycle --damping 0.19"));
  EXPECT_EQ(printed["drive"]["sensor.position"], "load");
  EXPECT_EQ(printed["engine"], "closed form");
  // Published numbers, so that a fault shared with the library would be seen.
  EXPECT_NEAR(printed["cycles"][0]["amplitude"].get<double>(), 0.241611108, 1e-9);
  EXPECT_NEAR(printed["cycles"][0]["period"].get<double>(), 6.456205, 1e-6);
}

TEST(LimitCycleCommand, BoundsAreProvedAndHoldWhatIsComputed) {
  const json printed = answer_of_sample();
  EXPECT_EQ(printed["certainty"], "enclosed");
  EXPECT_EQ(printed["completeness"], "enclosed");
  EXPECT_EQ(printed["cycles"][0]["certainty"], "enclosed");
  const auto expect_within = [](const json& range, double value) {
    EXPECT_LE(range["low"].get<double>(), value);
    EXPECT_GE(range["high"].get<double>(), value);
    EXPECT_LT(range["high"].get<double>() - range["low"].get<double>(), 1e-12 * value);
  };
  const json& cycle = printed["cycles"][0];
  expect_within(printed["bounds"]["growth_at_rest"], printed["growth_at_rest"]);
  expect_within(printed["bounds"]["amplitude"], cycle["amplitude"]);
  expect_within(printed["bounds"]["period"], cycle["period"]);
  expect_within(printed["bounds"]["multiplier"], cycle["multiplier"]);
  const json searched = answer_of_sample({"--restitution", "0.3"});
  EXPECT_EQ(searched["certainty"], "searched");
  EXPECT_EQ(searched["cycles"][0]["certainty"], "computed");
  EXPECT_TRUE(searched["bounds"].is_null());
  EXPECT_NEAR(searched["cycles"].at(0)["amplitude"].get<double>(), 0.2401, 5e-5);
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
  std::vector<std::string> words = {"--damping",        "1.2", "--inertia-ratio", "1",
                                    "--friction-ratio", "0.5", "--backlash",      "0.3",
                                    "--restitution",    "1"};
  const json printed = answer_of(words);
  EXPECT_EQ(printed["is_dissipative"], true);
  EXPECT_EQ(printed["certainty"], "theorem");
  words.insert(words.begin(), "limit-cycle");
  const Outcome text = run_tool(words);
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("The servo cannot hunt with any"), HasSubstr("This is proved.")));
}

TEST(LimitCycleCommand, PrintsWhatIsKnownAtItsTimeLimit) {
  const Outcome run = run_tool(
      {"limit-cycle", "examples/robot-joint.toml", "--format", "json", "--time-limit", "1 ms"});
  EXPECT_EQ(run.status, 1) << run.err;
  const json answer = json::parse(run.out);
  EXPECT_FALSE(answer["search"]["is_complete"].get<bool>());
  EXPECT_THAT(run.err, HasSubstr("stopped early"));
  EXPECT_LT(answer["search"]["starts"].size(), 10U);
}

TEST(LimitCycleCommand, RefusesWhatIsNoLimitSpecificationOrMeasurement) {
  const std::string size = ": must be a size of at least 100 MB";
  for (const auto& [option, value, fault] :
       {std::tuple("--time-limit", "0 s", "--time-limit = 0 s: must be positive, in s"),
        std::tuple("--memory-limit", "much", size.c_str()),
        std::tuple("--memory-limit", "-1 GB", size.c_str()),
        std::tuple("--memory-limit", "99 MB", size.c_str()),
        std::tuple("--memory-limit", "0", size.c_str()),
        std::tuple("--specification", "0 rad", "--specification"),
        std::tuple("--measured", "0.25 rad", "--measured"),
        std::tuple("--measured", "0.25 rad, 3 kg", "--measured"),
        std::tuple("--measured", "-1 rad, 1 Hz", "--measured"),
        std::tuple("--measured", "1 rad, 0 Hz", "--measured")}) {
    const Outcome run = run_tool(with_sample_servo({"limit-cycle", option, value}));
    EXPECT_EQ(run.status, 2) << option << value;
    EXPECT_THAT(run.err, HasSubstr(fault)) << option << value;
  }
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

TEST(LimitCycleCommand, PhysicalNumbersAreThoseOfTheDataSheet) {
  const json printed = answer_of({"examples/elinco-fd162.toml"});
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

TEST(LimitCycleCommand, DegenerateServosHaveAnAnswer) {
  const auto verdict = [](const char* damping, const char* backlash) {
    const Outcome run = run_tool({"limit-cycle", "--damping", damping, "--inertia-ratio", "1",
                                  "--friction-ratio", "0.5", "--backlash", backlash});
    EXPECT_EQ(run.status, 0);
    return run.out;
  };
  EXPECT_THAT(verdict("0", "0.1"), StartsWith("grows without bound"));
  EXPECT_THAT(verdict("0", "0"), StartsWith("undamped"));
  EXPECT_THAT(verdict("0.5", "0"), StartsWith("cannot hunt: no backlash (proved)\n"));
  EXPECT_THAT(verdict("100", "0.1"),
              StartsWith("cannot hunt: comes to rest at the reference (proved)\n"));
}

TEST(LimitCycleCommand, StatesTheWidestBacklashThatMeetsASpecification) {
  const std::vector<std::string> specification = {"--specification", "0.1 rad"};
  const json stated = answer_of_sample(specification);
  EXPECT_EQ(stated["specification"]["permitted"], 0.1);
  EXPECT_EQ(stated["specification"]["small"], "not met");
  EXPECT_GT(stated["ceiling"]["load"], 0.1);
  const double widest = stated["widest_backlash"];
  EXPECT_NEAR(widest, 0.1 / 0.8542, 1e-4);
  const json met =
      answer_of({"--damping", "0.19", "--inertia-ratio", "2", "--friction-ratio", "0.1",
                 "--backlash", std::to_string(0.999 * widest), specification[0], specification[1]});
  EXPECT_EQ(met["ceiling"]["load"].get<double>() <= 0.1, true);
}

TEST(LimitCycleCommand, ComparesMeasuredHuntingWithWhatItFinds) {
  const json measured = answer_of_sample({"--measured", "0.25 rad, 6.5 s"});
  EXPECT_EQ(measured["measured"]["amplitude"], 0.25);
  ASSERT_EQ(measured["beside_measured"].size(), 1U);
  EXPECT_EQ(measured["beside_measured"][0]["list"], "cycles");
  EXPECT_NEAR(measured["beside_measured"][0]["amplitude_share"], 0.25 / 0.241611108 - 1.0, 1e-8);
  EXPECT_NEAR(measured["beside_measured"][0]["frequency_share"], 6.456205 / 6.5 - 1.0, 1e-6);
  const json of_frequency = answer_of_sample({"--measured", "12 deg, 0.2 Hz"})["measured"];
  EXPECT_NEAR(of_frequency["frequency"], 0.2, 1e-15);
  EXPECT_THAT(run_tool(with_sample_servo({"limit-cycle", "--measured", "0.25 rad, 6.5 s"})).out,
              AllOf(StartsWith("hunts: ±0.242 rad, period 6.456 / ω_n (proved)\n"),
                    HasSubstr("amplitude +3.47 %, frequency -0.674 %")));
}

TEST(LimitCycleCommand, ReportsMarginsOfAMasslessSideToo) {
  for (const char* massless : {"0", "inf"}) {
    const json margin =
        answer_of({"--damping", "0.3", "--inertia-ratio", massless, "--friction-ratio", "0.4",
                   "--backlash", "0.3", "--restitution", "0.3", "--margins"})["margin"];
    EXPECT_EQ(margin["parameters"].size(), 9U);
    for (const auto& one : margin["parameters"]) EXPECT_EQ(one["kind"], "certified");
    EXPECT_TRUE(margin["overall"].is_object());
  }
}

TEST(LimitCycleCommand, OffersWhatWasNotAskedFor) {
  const std::string some = run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--margins"}).out;
  const std::size_t offer = some.find("More: ");
  ASSERT_NE(offer, std::string::npos);
  EXPECT_EQ(some.find("--margins", offer), std::string::npos);
  EXPECT_THAT(
      run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--margins", "--sensitivities"}).out,
      Not(HasSubstr("--sensitivities.")));
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
              AllOf(HasSubstr("Where hunting ends"), HasSubstr("\n  load.inertia "),
                    HasSubstr("\n  sensor.position "), HasSubstr("Searched, not proved")));
  asked.insert(asked.end(), {"--format", "json"});
  const auto margin = json::parse(run_tool(asked).out)["margin"];
  ASSERT_EQ(margin["parameters"].size(), 3U);
  EXPECT_EQ(margin["parameters"][1]["kind"], "certified");
  EXPECT_EQ(margin["parameters"][2]["kind"], "searched");
  EXPECT_FALSE(margin["overall"].is_null());
  asked.erase(asked.begin() + 2);
  EXPECT_THAT(run_tool(asked).err, HasSubstr("--parameters = load.inertia: must come with"));
}

TEST(LimitCycleCommand, TellsHowFarHuntingIsOfADriveThatIsSearched) {
  const auto margin_of = [](const std::vector<std::string>& more, int status) {
    std::vector<std::string> arguments = {
        "limit-cycle",
        "examples/symptoms/joint.toml",
        "--margins",
        "--format",
        "json",
        "--parameters",
        "gearbox.backlash=10 arcmin:100 arcmin:3,controller.proportional=200:2000:4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.status, status) << run.err;
    return json::parse(run.out)["margin"];
  };
  const json margin = margin_of({}, 0);
  EXPECT_EQ(margin["hunts"], false);
  EXPECT_EQ(margin["stopped"], false);
  EXPECT_TRUE(margin["overall"].is_null());
  ASSERT_EQ(margin["parameters"].size(), 2U);
  const json& gain = margin["parameters"][1];
  EXPECT_EQ(gain["kind"], "searched");
  EXPECT_TRUE(gain["below"].is_null());
  const double alone = gain["above"].get<double>() / gain["present"].get<double>();
  const double together = margin["combined"]["factors"][1];
  EXPECT_GT(together, 1.0);
  EXPECT_LT(together, alone);
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
