// gearlash design as a user calls it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tool.hpp"

namespace gearlash::design_command_test {
namespace {

using test::file_text;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(DesignCommand, AnswersPutIntoTheDataSheetMeetTheTarget) {
  const std::pair<std::string, std::string> parameters[] = {
      {"gearbox.backlash", " rad"},    {"controller.proportional", " V/rad"},
      {"load.friction", " N m s/rad"}, {"motor.friction", " N m s/rad"},
      {"load.inertia", " kg m2"},      {"gearbox.ratio", ""}};
  std::string names;
  for (const auto& [name, unit] : parameters) names += (names.empty() ? "" : ",") + name;
  const Outcome run = run_tool({"design", "examples/elinco-fd162.toml", "--target", "size <= 1 deg",
                                "--parameters", names, "--format", "json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto design = nlohmann::json::parse(run.out);
  EXPECT_EQ(design["design"]["met"], "none");
  const double limit = std::acos(-1.0) / 180.0;
  for (std::size_t i = 0; i < std::size(parameters); ++i) {
    const auto& [name, unit] = parameters[i];
    SCOPED_TRACE(name);
    const auto& designed = design["design"]["parameters"].at(i);
    const auto& answer = designed["values"];
    EXPECT_EQ(answer["parameter"], name);
    ASSERT_FALSE(answer["intervals"].empty());
    std::vector<std::string> values = {designed["results"][0]["value"].dump()};
    if (name == "gearbox.ratio") {
      values.clear();
      for (const auto& interval : answer["intervals"]) {
        const bool is_at_start = interval["low"] == answer["searched"]["low"];
        values.push_back(interval[is_at_start ? "high" : "low"].dump());
      }
    }
    for (const std::string& value : values) {
      const Outcome then = run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--set",
                                     name + "=" + value + unit, "--format", "json"});
      const auto cycles = nlohmann::json::parse(then.out)["cycles"];
      ASSERT_FALSE(cycles.empty());
      EXPECT_NEAR(cycles[0]["amplitude"], limit, 1e-10 * limit);
    }
  }
}

TEST(DesignCommand, SaysOverWhichRangeNoValueMeetsTheTarget) {
  const Outcome run = run_tool({"design", "examples/elinco-fd162.toml", "--target", "no-hunting",
                                "--parameters", "motor.inertia"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(lines_of(run.out), Contains(StartsWith("  motor.inertia: no value from ")));
}

TEST(DesignCommand, TakesANormalizedServo) {
  const Outcome run =
      run_tool({"design", "--damping", "0.19", "--inertia-ratio", "2", "--friction-ratio", "1/10",
                "--backlash", "0.3", "--target", "size <= 0.1", "--parameters", "backlash"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("  servo.backlash  0.3 rad  at most 0.124166 rad  −58.6 %"));
}

TEST(DesignCommand, DrawsTheTwoParametersThatItAnswers) {
  const Scratch scratch;
  const auto picture = scratch / "region.svg";
  const Outcome run =
      run_tool({"design", "examples/elinco-fd162.toml", "--target", "size <= 1 deg", "--vary",
                "controller.proportional,load.friction", "--plot", "region=" + picture.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(lines_of(run.out), Contains(StartsWith("  load.friction ")));
  EXPECT_THAT(lines_of(run.out), Not(Contains(StartsWith("  gearbox.backlash "))));
  EXPECT_THAT(file_text(picture), HasSubstr("Target: size &lt;= 1 deg"));
}

TEST(EdgeDesignCommand, PicturesThatCannotBeDrawnAreRefused) {
  const auto faults_of = [](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"design", "examples/elinco-fd162.toml", "--target",
                                          "no-hunting"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.status, 2);
    return lines_of(run.err);
  };
  EXPECT_THAT(
      faults_of({"--vary", "backlash,backlash", "--plot", "region=a.txt", "--quantity", "money"}),
      ElementsAre(StartsWith("gearlash: --vary = backlash, backlash: must be two"),
                  StartsWith("gearlash: --plot = a.txt: must"),
                  StartsWith("gearlash: --quantity = money: must be ")));
  EXPECT_THAT(faults_of({"--vary", "backlash,load.colour", "--plot", "region=a.svg"}),
              Contains(StartsWith("gearlash: --vary = load.colour: must be")));
  EXPECT_THAT(faults_of({"--vary", "load.friction=1e-5:1e-5:1,backlash", "--plot", "region=a.svg"}),
              ElementsAre(StartsWith("gearlash: --vary = 1 value: must have two values")));
  EXPECT_THAT(faults_of({"--vary", "backlash,controller.proportional"}),
              ElementsAre(StartsWith("gearlash: --plot is missing: must name the picture")));
  EXPECT_THAT(faults_of({"--plot", "region=a.svg"}),
              ElementsAre(StartsWith("gearlash: --vary is missing: must name the two parameters")));
}

TEST(EdgeDesignCommand, FaultsAreToldAtOnce) {
  const Outcome run =
      run_tool({"design", "examples/elinco-fd162.toml", "--target", "speed <= 1 and size <= 2 kg",
                "--parameters", "backlash,colour", "--damping", "0.2", "--format", "xml"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(
      lines_of(run.err),
      ElementsAre("gearlash: --format = xml: must be text or json",
                  StartsWith("gearlash: --target = speed <= 1: must be no-hunting"),
                  StartsWith("gearlash: --target = size <= 2 kg: must be"),
                  StartsWith("gearlash: --parameters = colour: must be a number or a choice")));
  const Outcome missing = run_tool({"design", "examples/elinco-fd162.toml"});
  EXPECT_EQ(missing.status, 2);
}

/// FINDINGS B1 of version 0.2: "no value meets the target", searched from 0.1 to 10 times.
TEST(DesignCommand, AConditionMoreLosesNoProof) {
  const auto answers_of = [](const std::string& target) {
    const Outcome run =
        run_tool({"design", "examples/elinco-fd162.toml", "--target", target, "--parameters",
                  "load.friction,controller.motor_speed_feedback", "--format", "json"});
    EXPECT_EQ(run.status, 0) << run.err;
    const auto printed = nlohmann::json::parse(run.out);
    std::vector<nlohmann::json> answers;
    for (const auto& one : printed["design"]["parameters"]) {
      answers.push_back(one["values"]);
    }
    return answers;
  };
  const auto alone = answers_of("no-hunting");
  const auto kept = answers_of("no-hunting and bandwidth >= 0.01 Hz");
  const auto narrowed = answers_of("no-hunting and bandwidth >= 1 Hz");
  for (const auto& answers : {kept, narrowed}) {
    EXPECT_EQ(answers[0]["kind"], "certified");
    EXPECT_EQ(answers[0]["searched"], alone[0]["searched"]);
    EXPECT_EQ(answers[0]["searched_within"]["limits"][0]["quantity"], "bandwidth");
    EXPECT_EQ(answers[0]["intervals"][0]["low"], alone[0]["intervals"][0]["low"]);
  }
  EXPECT_EQ(kept[0]["intervals"], alone[0]["intervals"]);
  EXPECT_EQ(kept[1]["intervals"], alone[1]["intervals"]);
  EXPECT_LT(narrowed[0]["intervals"][0]["high"], alone[0]["intervals"][0]["high"]);
}

/// The tachometer that a design asks for, typed into the drive.
TEST(DesignCommand, ATachometerThatIsAskedForEndsTheHunting) {
  const auto verdict_with = [](const char* feedback) {
    const Outcome run =
        run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--set",
                  std::string("controller.motor_speed_feedback=") + feedback, "--format", "json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(run.out)["verdict"].get<std::string>();
  };
  EXPECT_EQ(verdict_with("7.5022 V s/rad"), "hunts");
  EXPECT_EQ(verdict_with("7.5023 V s/rad"), "cannot hunt");
}

TEST(DesignCommand, TakesAnyNumberOfTheClosedFormByItsPath) {
  const Outcome run = run_tool(
      {"design", "examples/elinco-fd162.toml", "--set", "motor.resistance=300 ohm", "--target",
       "no-hunting", "--parameters", "motor.resistance,controller.kp", "--format", "json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto design = nlohmann::json::parse(run.out);
  const auto& parameters = design["design"]["parameters"];
  EXPECT_EQ(parameters[0]["values"]["parameter"], "motor.resistance");
  EXPECT_EQ(parameters[0]["values"]["present"], 300.0);
  EXPECT_EQ(parameters[1]["values"]["parameter"], "controller.proportional");
}

// ---- drives that are searched -------------------------------------------------------------------

TEST(DesignCommand, OfAnyDriveAreItsAnswersThoseOfLimitCycle) {
  const std::vector<std::string> words = {"design",       "examples/first-servo.toml",
                                          "--target",     "amplitude <= 15 arcmin and no-runaway",
                                          "--parameters", "controller.proportional=10:160:4"};
  std::vector<std::string> json_words = words;
  json_words.insert(json_words.end(), {"--format", "json"});
  const Outcome run = run_tool(json_words);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto design = nlohmann::json::parse(run.out);
  EXPECT_EQ(design["design"]["met"], "none");
  const auto& designed = design["design"]["parameters"][0];
  const auto& answer = designed["values"];
  EXPECT_EQ(answer["kind"], "searched");
  EXPECT_EQ(answer["grid"].size(), 5U);
  ASSERT_FALSE(answer["intervals"].empty());
  const double end = answer["intervals"].back()["high"];
  const double limit = 15.0 / 60.0 * std::numbers::pi / 180.0;
  const auto largest_with = [&](double gain) {
    const Outcome one =
        run_tool({"limit-cycle", "examples/first-servo.toml", "--set",
                  "controller.proportional=" + nlohmann::json(gain).dump() + " N m/rad", "--format",
                  "json"});
    double largest = 0.0;
    const auto found = nlohmann::json::parse(one.out);
    for (const auto& cycle : found["cycles"]) {
      largest = std::max(largest, cycle["amplitude"].get<double>());
    }
    return largest;
  };
  EXPECT_LE(largest_with(end), limit);
  EXPECT_GT(largest_with(1.001 * end), limit);
  EXPECT_NE(designed["results"][0]["answer"]["step"], nullptr);
  // Less gain turns the loop less, and makes it slower.
  const auto& present = design["design"]["present"]["answer"]["loop"];
  const auto& loop = designed["results"][0]["answer"]["loop"];
  EXPECT_EQ(loop["is_stable"], true);
  EXPECT_GT(loop["phase_margin"], present["phase_margin"]);
  EXPECT_LT(loop["bandwidth"], present["bandwidth"]);
  const Outcome text = run_tool(words);
  EXPECT_THAT(text.out, HasSubstr("at present: hunts: ±22.8 arcmin at 3.91 Hz, not met"));
  EXPECT_THAT(text.out,
              HasSubstr("(controller.proportional, 5 values\nfrom 10 N m/rad to 160 N m/rad)"));
  EXPECT_THAT(text.out, HasSubstr("overshoot  settles  bandwidth  phase margin\n"));
}

TEST(DesignCommand, ATargetOnCeilingsIsProved) {
  const std::vector<std::string> words = {"design",       "examples/telescope-axis.toml",
                                          "--target",     "ceiling <= 6.3 arcmin",
                                          "--parameters", "gearbox.backlash=5 arcmin:20 arcmin:2"};
  const Outcome run = run_tool(words);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Every value of these parts meets the target\n"
                                 "  gearbox.backlash 5 to 20 arcmin: proved for 5 to 20 arcmin "
                                 "(1 box)\n"));
  EXPECT_THAT(run.out, HasSubstr("computed at many values, not bounded over them: ceiling."));
  std::vector<std::string> as_json = words;
  as_json.insert(as_json.end(), {"--format", "json"});
  const auto answer =
      nlohmann::json::parse(run_tool(as_json).out)["design"]["parameters"][0]["values"];
  ASSERT_EQ(answer["proofs"].size(), 1U);
  EXPECT_EQ(answer["proofs"][0]["parts"], answer["intervals"]);
  EXPECT_EQ(answer["proofs"][0]["reason"], nullptr);
}

TEST(DesignCommand, OfAnyDriveTriesEveryWord) {
  const auto run_with = [](const std::string& target) {
    const Outcome run = run_tool({"design", "examples/first-servo.toml", "--target", target,
                                  "--parameters", "sensor.position"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  };
  EXPECT_THAT(run_with("no-hunting"), HasSubstr("  sensor.position  load  motor  "));
  EXPECT_THAT(run_with("bandwidth >= 1 kHz"), HasSubstr("sensor.position: no choice; closest is"));
}

TEST(EdgeDesignCommand, OfAnyDriveFaultsAreToldAllAtOnce) {
  const Outcome run = run_tool({"design", "examples/robot-joint.toml", "--target", "ceiling >= x",
                                "--parameters", "load.colour,motor.coulomb=1:0:3", "--vary",
                                "gearbox.ratio,gearbox.backlash", "--plot", "region=region.svg"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(lines_of(run.err), ElementsAre(HasSubstr("--target = ceiling >= x"),
                                             HasSubstr("--parameters = load.colour"),
                                             HasSubstr("--parameters = 1 to 0: must rise")));
}

TEST(DesignCommand, DrawsWhereTwoParametersOfAnyDriveMeetTheTarget) {
  const Scratch scratch;
  const auto picture = scratch / "region.svg";
  const Outcome run =
      run_tool({"design", "examples/first-servo.toml", "--target", "amplitude <= 15 arcmin",
                "--parameters", "gearbox.backlash=10 arcmin:30 arcmin:2", "--vary",
                "controller.proportional=10:80:4,gearbox.backlash=10 arcmin:30 arcmin:4", "--plot",
                "region=" + picture.string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string svg = file_text(picture);
  for (const char* text : {"Target: amplitude &lt;= 15 arcmin", ">met<", ">missed<", ">limit<",
                           "bandwidth (Hz)", "gearbox backlash (arcmin)", ">now<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

/// Ranges that leave what is permitted of the parameter, or of the drive, are cut to it.
TEST(DesignCommand, CutsRangesToWhatIsPermitted) {
  const Outcome usual =
      run_tool({"design", "--damping", ".23", "--inertia-ratio", "3", "--friction-ratio", ".15",
                "--backlash", ".2", "--target", "no-hunting", "--parameters", "friction-ratio"});
  EXPECT_EQ(usual.status, 0) << usual.err;
  EXPECT_THAT(usual.out, HasSubstr("servo.friction_ratio: no value from 0 to 1"));
  const Outcome of_drive =
      run_tool({"design", "examples/symptoms/joint.toml", "--sensor", "motor", "--target",
                "settling-time <= 200 ms", "--parameters", "gearbox.backlash=0:20 arcmin:3"});
  EXPECT_EQ(of_drive.status, 0) << of_drive.err;
  EXPECT_THAT(of_drive.out, HasSubstr(" from 10 arcmin to 20 arcmin"));
  const std::vector<std::string> restitution = {
      "design", "--damping",  ".23", "--inertia-ratio", "3",          "--friction-ratio",
      ".15",    "--backlash", ".2",  "--target",        "no-hunting", "--parameters"};
  auto partly = restitution;
  partly.emplace_back("servo.friction_ratio=0.5:1.5:3");
  const Outcome typed = run_tool(partly);
  EXPECT_EQ(typed.status, 0);
  EXPECT_EQ(typed.err,
            "gearlash: --parameters servo.friction_ratio: left out: 1.5 (servo.friction_ratio must "
            "be from 0 to 1)\n");
  auto wholly = restitution;
  wholly.emplace_back("servo.friction_ratio=1.5:2:3");
  const Outcome refused = run_tool(wholly);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("servo.friction_ratio must be from 0 to 1"));
}

TEST(DesignCommand, SearchesAGapFromWhereItIsPermitted) {
  // A rigid gap of 0 is no drive that can be searched; the search begins beyond it.
  const Outcome run = run_tool({"design", "examples/symptoms/joint.toml", "--sensor", "motor",
                                "--target", "settling-time <= 200 ms", "--parameters",
                                "gearbox.backlash=0 arcmin:10 arcmin:3"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err,
              testing::StartsWith("gearlash: --parameters gearbox.backlash: left out: 0 "));
  EXPECT_THAT(run.out, HasSubstr("5 arcmin to 10 arcmin"));
  const Outcome usual =
      run_tool({"design", "examples/symptoms/joint.toml", "--sensor", "motor", "--target",
                "settling-time <= 200 ms", "--parameters", "gearbox.backlash"});
  EXPECT_EQ(usual.status, 0) << usual.err;
}

}  // namespace
}  // namespace gearlash::design_command_test
