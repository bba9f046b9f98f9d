// The requests of the page, answered natively.
#include "core.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gearlash/analyse.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"

namespace gearlash::web::core_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr char servo[] =
    "[servo]\ndamping = 0.19\ninertia_ratio = 2\nfriction_ratio = 0.1\nbacklash = \"0.3 rad\"\n";
constexpr char joint[] =
    "[motor]\nkind = \"torque-controlled\"\ninertia = \"0.12 kg cm2\"\nfriction = \"0.02 mN m "
    "s/rad\"\n"
    "[gearbox]\nratio = 50\nbacklash = \"30 arcmin\"\n"
    "[load]\ninertia = \"0.05 kg m2\"\nfriction = \"0.02 N m s/rad\"\n"
    "[controller]\nkind = \"PD\"\nshaft = \"load\"\nproportional = \"40 N m/rad\"\n"
    "derivative = \"0.5 N m s/rad\"\n";

/// A core whose clock stands still unless a test moves it.
class WebCore : public testing::Test {
 protected:
  Json ask(Json request) {
    const Reply reply = core_.ask(request.dump());
    numbers_ = reply.numbers;
    return Json::parse(reply.json);
  }
  using Settings = std::vector<std::pair<std::string, std::string>>;
  static Json drive(const char* toml, const Settings& settings = {}) {
    Json list = Json::array();
    for (const auto& [path, text] : settings) list.push_back(Json::array({path, text}));
    return {{"toml", toml}, {"name", "drive.toml"}, {"settings", std::move(list)}};
  }
  std::vector<double> column(const Json& place) const {
    const auto begin = numbers_.begin() + place.at("at").get<std::ptrdiff_t>();
    return {begin, begin + place.at("count").get<std::ptrdiff_t>()};
  }

  double seconds_ = 0.0;
  double seconds_a_look_ = 0.0;
  int reports_ = 0;
  Core core_{{.seconds = [this] { return seconds_ += seconds_a_look_; },
              .report = [this](double) { ++reports_; },
              .folder = testing::TempDir()}};
  std::vector<double> numbers_;
};

TEST_F(WebCore, AnswersAsTheCommandLineDoes) {
  for (const char* toml : {servo, joint}) {
    const Json reply = ask({{"ask", "answer"}, {"drive", drive(toml)}});
    const Drive parsed = parse_drive(toml);
    const Json expected = Json::parse(to_json(parsed, analyse(parsed, {.ceiling = true})));
    EXPECT_EQ(reply["answer"]["cycles"], expected["cycles"]);
    EXPECT_EQ(reply["answer"]["ceiling"], expected["ceiling"]);
    EXPECT_EQ(reply["level"], "fine");
  }
}

TEST_F(WebCore, TheCoarseAnswerOfAServoIsTheFineOneWithoutItsProof) {
  const Json coarse = ask({{"ask", "answer"}, {"level", "coarse"}, {"drive", drive(servo)}});
  const Json fine = ask({{"ask", "answer"}, {"drive", drive(servo)}});
  EXPECT_EQ(coarse["means"], "closed form");
  const std::string proved = " (proved)";
  const std::string fine_headline = fine["headline"];
  ASSERT_TRUE(fine_headline.ends_with(proved)) << fine_headline;
  EXPECT_EQ(coarse["headline"],
            fine_headline.substr(0, fine_headline.size() - proved.size()) + " (computed)");
  EXPECT_EQ(coarse["answer"]["certainty"], "computed");
  EXPECT_EQ(fine["answer"]["certainty"], "enclosed");
}

TEST_F(WebCore, ADraggedDriveIsFollowedFromTheSearchBefore) {
  const Json first = ask({{"ask", "answer"}, {"level", "coarse"}, {"drive", drive(joint)}});
  EXPECT_EQ(first["means"], "one start");
  const Json fine = ask({{"ask", "answer"}, {"drive", drive(joint)}});
  EXPECT_EQ(fine["means"], "search");
  const Json moved = drive(joint, {{"gearbox.backlash", "30.5 arcmin"}});
  const Json followed = ask({{"ask", "answer"}, {"level", "coarse"}, {"drive", moved}});
  EXPECT_EQ(followed["means"], "followed");
  const Json searched = ask({{"ask", "answer"}, {"drive", moved}});
  EXPECT_NEAR(followed["answer"]["cycles"][0]["amplitude"].get<double>(),
              searched["answer"]["cycles"][0]["amplitude"].get<double>(), 1e-10);
}

TEST_F(WebCore, AnotherFileIsNotFollowedFromTheOneBefore) {
  ask({{"ask", "answer"}, {"drive", drive(joint)}});
  const std::string other = std::string(joint) + "# another file\n";
  const Json reply = ask({{"ask", "answer"}, {"level", "coarse"}, {"drive", drive(other.c_str())}});
  EXPECT_EQ(reply["means"], "one start");
}

TEST_F(WebCore, EveryFaultHasItsPathValueAndPlace) {
  const Json reply =
      ask({{"ask", "answer"},
           {"drive", drive(servo, {{"servo.damping", "-1"}, {"servo.friction_ratio", "7"}})}});
  ASSERT_EQ(reply["faults"].size(), 2U);
  EXPECT_EQ(reply["faults"][0]["path"], "servo.damping");
  EXPECT_EQ(reply["faults"][0]["value"], "-1");
  EXPECT_NE(reply["faults"][0]["permitted"], "");
  EXPECT_EQ(reply["faults"][1]["path"], "servo.friction_ratio");
}

TEST_F(WebCore, TellsFaultsThatAValueCanMendFromOthers) {
  const std::string unknown = std::string(joint) + "[sensor]\nnoise = 1\nresolution = \"-1 deg\"\n";
  const Json reply = ask({{"ask", "drive"}, {"drive", drive(unknown.c_str())}});
  ASSERT_EQ(reply["faults"].size(), 2U) << reply.dump();
  for (const Json& fault : reply["faults"]) {
    EXPECT_EQ(fault["is_parameter"].get<bool>(), fault["path"] == "sensor.resolution") << fault;
  }
}

TEST_F(WebCore, WhatIsNoRequestIsRefusedInWords) {
  EXPECT_TRUE(Json::parse(core_.ask("{").json).contains("failure"));
  EXPECT_TRUE(Json::parse(core_.ask("{}").json).contains("failure"));
  EXPECT_TRUE(ask({{"ask", "nothing"}, {"drive", drive(servo)}}).contains("faults"));
  EXPECT_TRUE(ask({{"ask", "answer"}, {"drive", drive("\x01")}}).contains("faults"));
  EXPECT_TRUE(ask({{"ask", "thesis"}, {"figure", 99}}).contains("faults"));
}

TEST_F(WebCore, ParametersHaveValueUnitAndSlider) {
  const Json reply = ask({{"ask", "drive"}, {"drive", drive(joint)}});
  bool is_found = false;
  for (const Json& parameter : reply["parameters"]) {
    if (parameter["path"] != "gearbox.backlash") continue;
    is_found = true;
    EXPECT_EQ(parameter["unit"], "arcmin");
    EXPECT_DOUBLE_EQ(parameter["value"].get<double>() / parameter["unit_in_si"].get<double>(),
                     30.0);
    EXPECT_LT(parameter["slider"]["low"], parameter["value"]);
    EXPECT_GT(parameter["slider"]["high"], parameter["value"]);
  }
  EXPECT_TRUE(is_found);
  EXPECT_TRUE(reply["is_searched"].get<bool>());
}

TEST_F(WebCore, CurvesAreColumnsOfOneLength) {
  const Json reply = ask({{"ask", "answer"}, {"drive", drive(servo)}});
  ASSERT_EQ(reply["motions"].size(), 2U);  // the way there, and the cycle
  for (const Json& motion : reply["motions"]) {
    const std::vector<double> load = column(motion["load"]);
    const std::vector<double> motor = column(motion["motor"]);
    ASSERT_GT(load.size(), 100U);
    ASSERT_EQ(motor.size(), load.size());
    for (std::size_t i = 2; i < load.size(); i += 2) {
      EXPECT_EQ(motor[i], load[i]);
      EXPECT_GE(load[i], load[i - 2]);
    }
    EXPECT_EQ(motion["plot"]["columns"][0].size(), 3U);  // position, gap and torque
  }
}

TEST_F(WebCore, EventsOfEitherEngineHaveTheirWords) {
  for (const char* toml : {servo, joint}) {
    const Json reply = ask({{"ask", "answer"}, {"drive", drive(toml)}});
    for (const Json& motion : reply["motions"]) {
      ASSERT_GT(motion["events"].size(), 1U);
      for (const Json& event : motion["events"]) {
        const std::string what = event["what"];
        EXPECT_TRUE(what == "faces part" || what.starts_with("impact ")) << what;
      }
    }
  }
}

TEST_F(WebCore, AnEncoderReadsWholeSteps) {
  const Json reply = ask(
      {{"ask", "answer"},
       {"drive", drive(joint, {{"sensor.resolution", "1 arcmin"}, {"sampling.period", "1 ms"}})}});
  const double step = std::numbers::pi / 180.0 / 60.0 / reply["unit_in_si"].get<double>();
  std::vector<double> points;
  for (const Json& layer : reply["motions"][0]["plot"]["columns"][0][0]["layers"]) {
    if (layer["name"] == "encoder reading") points = column(layer["points"]);
  }
  ASSERT_GT(points.size(), 100U);
  for (std::size_t i = 1; i < points.size(); i += 2) {
    EXPECT_NEAR(points[i] / step, std::round(points[i] / step), 1e-9);
  }
}

TEST_F(WebCore, AMapHasItsBorderAndItsUnits) {
  const Json reply = ask({{"ask", "picture"},
                          {"kind", "map"},
                          {"drive", drive(servo)},
                          {"x", "servo.inertia_ratio=0.1:10:15:log"},
                          {"y", "servo.damping=0.05:2:15:log"}});
  const Json& panel = reply["plot"]["columns"][0][0];
  bool has_border = false;
  for (const Json& layer : panel["layers"]) {
    has_border =
        has_border || (layer["name"] == "hunting ends" && !column(layer["points"]).empty());
  }
  EXPECT_TRUE(has_border);
  EXPECT_FALSE(panel["texts"].empty());  // the contours' numbers
  EXPECT_EQ(reply["x"]["path"], "servo.inertia_ratio");
}

TEST_F(WebCore, AMapOfMorePointsThanAStdSizeTOfWebAssemblyIsRefused) {
  const Json reply = ask({{"ask", "picture"},
                          {"kind", "map"},
                          {"drive", drive(servo)},
                          {"x", "servo.inertia_ratio=0.1:10:65536"},
                          {"y", "servo.damping=0.05:2:65536"}});
  EXPECT_TRUE(reply.contains("faults"));
}

TEST_F(WebCore, AChartHasBranchesAndTheBorderOfHunting) {
  const Json reply = ask({{"ask", "picture"},
                          {"kind", "bifurcation"},
                          {"drive", drive(servo)},
                          {"x", "servo.damping=0.1:2:25:log"}});
  std::vector<std::string> names;
  for (const Json& layer : reply["plot"]["columns"][0][0]["layers"]) {
    const bool is_named = !layer["name"].is_null();
    if (is_named && !column(layer["points"]).empty()) names.push_back(layer["name"]);
  }
  EXPECT_EQ(std::count(names.begin(), names.end(), "stable cycle"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "unstable cycle"), 0);
  const bool has_border = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return !name.empty() && name != "stable cycle" && name != "can come to rest";
  });
  EXPECT_TRUE(has_border);
}

TEST_F(WebCore, EveryOtherPictureIsDrawnOrSaysWhyNot) {
  for (const char* kind : {"ceiling", "tornado", "nyquist", "comparison", "curves"}) {
    const Json reply = ask({{"ask", "picture"},
                            {"kind", kind},
                            {"drive", drive(servo)},
                            {"x", "servo.damping=0.1:0.3:3"}});
    EXPECT_FALSE(reply["plot"]["columns"][0][0]["layers"].empty()) << kind;
    EXPECT_FALSE(reply["plot"]["description"].is_null()) << kind;
  }
  const Json reply = ask({{"ask", "picture"}, {"kind", "yield"}, {"drive", drive(servo)}});
  EXPECT_EQ(reply["faults"][0]["path"], "varied");
}

TEST_F(WebCore, MarginsAreTextsThatCanBeSet) {
  const Json reply = ask({{"ask", "margins"},
                          {"drive", drive(servo)},
                          {"parameters", {"servo.damping", "servo.backlash"}}});
  ASSERT_EQ(reply["texts"].size(), 2U);
  const Json& damping = reply["texts"][0];
  EXPECT_TRUE(damping["is_setting"].get<bool>());
  const Json set = drive(servo, {{"servo.damping", damping["above"].get<std::string>()}});
  const Json there = ask({{"ask", "answer"}, {"drive", set}});
  EXPECT_NEAR(there["answer"]["growth_at_rest"].get<double>(), 1.0, 1e-4);
}

TEST_F(WebCore, MarginsAreInTheUnitOfTheAuthor) {
  const Json reply = ask({{"ask", "margins"},
                          {"drive", drive(joint, {{"load.inertia", "500 kg cm2"}})},
                          {"parameters", Json::array({"load.inertia=400 kg cm2:600 kg cm2:2"})}});
  EXPECT_EQ(reply["texts"][0]["present"], "500 kg cm2");
  EXPECT_EQ(reply["texts"][0]["searched"], "400 kg cm2 to 600 kg cm2");
}

TEST_F(WebCore, AFigureOfTheThesisHasTheProgramsPoints) {
  const Json reply = ask({{"ask", "thesis"}, {"figure", 12}});
  const Json& layers = reply["columns"][0][0]["layers"];
  EXPECT_EQ(layers[0]["name"], "load");
  EXPECT_FALSE(column(layers[0]["points"]).empty());
  EXPECT_EQ(layers[1]["kind"], "marks");
  EXPECT_FALSE(column(layers[1]["points"]).empty());
}

TEST_F(WebCore, ASearchEndsWithWhatIsKnownWhenItsTimeIsOver) {
  seconds_a_look_ = 1.0;
  const Json reply = ask({{"ask", "answer"}, {"drive", drive(joint)}, {"seconds", 5}});
  EXPECT_FALSE(reply["is_complete"].get<bool>());
  EXPECT_GT(reports_, 0);
}

TEST_F(WebCore, TheSavedFileIsTheSameDrive) {
  const Json file =
      ask({{"ask", "file"}, {"drive", drive(joint, {{"gearbox.backlash", "7 arcmin"}})}});
  Drive expected = parse_drive(joint);
  set(expected, "gearbox.backlash", "7 arcmin");
  EXPECT_EQ(to_toml(parse_drive(file["toml"].get<std::string>())), to_toml(expected));
}

TEST_F(WebCore, ATableStandsInItsFolder) {
  std::ofstream(testing::TempDir() + "steps-of-the-page.csv")
      << "time (s), position (rad)\n0, 0\n1, 0.2\n2, 0.2\n";
  const std::string toml =
      std::string(joint) + "[reference]\nkind = \"table\"\nfile = \"steps-of-the-page.csv\"\n";
  EXPECT_TRUE(ask({{"ask", "answer"}, {"drive", drive(toml.c_str())}}).contains("headline"));
  const std::string missing =
      std::string(joint) + "[reference]\nkind = \"table\"\nfile = \"not-there.csv\"\n";
  EXPECT_TRUE(ask({{"ask", "answer"}, {"drive", drive(missing.c_str())}}).contains("faults"));
}

}  // namespace
}  // namespace gearlash::web::core_test
