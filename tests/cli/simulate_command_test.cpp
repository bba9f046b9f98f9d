// gearlash simulate: tables that read back as exactly the trajectory of the library.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gearlash/motion.hpp"
#include "tool.hpp"

namespace gearlash::simulate_command_test {
namespace {

using nlohmann::json;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::with_sample_servo;
using testing::ElementsAre;
using testing::HasSubstr;

/// The thesis's sample problem, asked to be at `reference`.
Drive sample_drive(double reference, double restitution = 0.0) {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3, restitution);
  drive.reference = reference;
  return drive;
}

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// A row of names and then rows of cells: nothing else is in the file.
Table table_of(const Outcome& run) {
  EXPECT_EQ(run.status, 0) << run.err;
  Table table;
  for (const std::string& line : lines_of(run.out)) {
    if (table.columns.empty()) {
      table.columns = cells_of(line);
    } else {
      table.rows.push_back(cells_of(line));
    }
  }
  return table;
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

void expect_state(const std::vector<std::string>& row, std::size_t first, const Shafts& shafts) {
  EXPECT_EQ(number(row.at(first)), shafts.load_position);
  EXPECT_EQ(number(row.at(first + 1)), shafts.load_speed);
  EXPECT_EQ(number(row.at(first + 2)), shafts.motor_position);
  EXPECT_EQ(number(row.at(first + 3)), shafts.motor_speed);
}

TEST(SimulateCommand, CsvReadsBackAsExactlyTheMotion) {
  const Table table = table_of(run_tool(
      with_sample_servo({"simulate", "--until", "20", "--every", "0.07", "--initial-position",
                         "0.5", "--initial-speed", "-1/3", "--reference", "0.25"})));
  EXPECT_THAT(table.columns,
              ElementsAre("time_s", "load_position_rad", "load_speed_rad_per_s",
                          "motor_position_rad", "motor_speed_rad_per_s", "motor_torque_N_m",
                          "reference_rad", "load_torque_N_m", "mode", "is_apart"));
  const Start start{.load_position = 0.5, .load_speed = -1.0 / 3.0};
  const Motion motion = simulate(sample_drive(0.25), {.until = 20.0, .start = start});
  ASSERT_EQ(table.rows.size(), 286U);
  for (const auto& row : table.rows) {
    const MotionSample sample = motion.at(number(row[0]));
    expect_state(row, 1, sample.shafts);
    EXPECT_EQ(number(row[5]), sample.motor_torque);
    EXPECT_EQ(row[6], "0.25");
    EXPECT_EQ(row[7], "0");
    EXPECT_EQ(row[8], sample.mode);
    EXPECT_EQ(row[9], sample.is_apart ? "1" : "0");
  }
}

TEST(SimulateCommand, TimesOfSamplesAreWrittenAsTheStepIs) {
  const Table table =
      table_of(run_tool(with_sample_servo({"simulate", "--until", "0.03", "--every", "0.003"})));
  ASSERT_EQ(table.rows.size(), 11U);
  EXPECT_EQ(table.rows[3][0], "0.009");
  EXPECT_EQ(table.rows[10][0], "0.03");
}

/// In a step of 1 rad a gap of some arc minutes would not be seen.
TEST(SimulateCommand, TheStepIsOfSomeBacklashesOrCountsUnlessTheFileHasOne) {
  const auto reference = [](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", "--until", "1", "--every", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return number(table_of(run_tool(words)).rows.at(1).at(6));
  };
  const double degree = std::numbers::pi / 180.0;
  EXPECT_DOUBLE_EQ(reference({"--damping", "0.2", "--inertia-ratio", "1", "--friction-ratio", "0.5",
                              "--backlash", "12 arcmin"}),
                   degree);
  EXPECT_DOUBLE_EQ(reference({"examples/robot-joint.toml"}), 20.0 * degree);
  EXPECT_DOUBLE_EQ(reference({"examples/robot-joint.toml", "--set", "reference=none"}),
                   10.0 * degree);
  EXPECT_DOUBLE_EQ(reference({"examples/robot-joint.toml", "--set", "reference=none", "--set",
                              "gearbox.backlash=1 arcmin"}),
                   20.0 * 2.0 * std::numbers::pi / (64.0 * 50.0));
}

TEST(SimulateCommand, RunsTenNaturalPeriodsInAThousandStepsByDefault) {
  const Table table = table_of(run_tool(with_sample_servo({"simulate"})));
  ASSERT_EQ(table.rows.size(), 1001U);
  EXPECT_NEAR(number(table.rows.back()[0]), 20.0 * std::numbers::pi, 1e-9);
}

TEST(SimulateCommand, EventsReadBackExactly) {
  for (const char* restitution : {"0", "0.6"}) {
    const Table table =
        table_of(run_tool(with_sample_servo({"simulate", "--until", "30", "--events", "--reference",
                                             "1", "--restitution", restitution})));
    const Motion motion = simulate(sample_drive(1.0, number(restitution)), {.until = 30.0});
    ASSERT_EQ(table.rows.size(), motion.events().size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const MotionEvent& event = motion.events()[i];
      const auto& row = table.rows[i];
      EXPECT_EQ(number(row[0]), event.time);
      EXPECT_EQ(row[1], event.what);
      EXPECT_EQ(row[2], event.mode_after);
      EXPECT_EQ(row[3].empty(), !event.energy_lost.has_value());
      EXPECT_EQ(number(row[3]), event.energy_lost.value_or(0.0));
      expect_state(row, 4, event.before);
      expect_state(row, 8, event.after);
    }
  }
}

TEST(SimulateCommand, JsonHoldsSamplesEventsBooksAndWhereItStopped) {
  const Outcome run =
      run_tool(with_sample_servo({"simulate", "--until", "12", "--every", "0.5", "--format", "json",
                                  "--restitution", "0.3", "--reference", "1"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const json printed = json::parse(run.out);
  const Motion motion = simulate(sample_drive(1.0, 0.3), {.until = 12.0});
  EXPECT_EQ(printed["schema"], "gearlash/simulate/3");
  EXPECT_EQ(printed["engine"], "closed form");
  EXPECT_EQ(printed["stop"], "reached_end");
  EXPECT_EQ(printed["events"].size(), motion.events().size());
  EXPECT_EQ(printed["events"].back()["time"].get<double>(), motion.events().back().time);
  EXPECT_EQ(printed["events"].back()["after"]["motor_speed"].get<double>(),
            motion.events().back().after.motor_speed);
  EXPECT_GT(printed["energy"]["impacts"].get<double>(), 0.0);
  EXPECT_EQ(printed["samples"]["columns"][1], "load_position");
  ASSERT_EQ(printed["samples"]["rows"].size(), 25U);
  for (const json& row : printed["samples"]["rows"]) {
    EXPECT_EQ(row[1].get<double>(), motion.at(row[0].get<double>()).shafts.load_position);
  }
  EXPECT_EQ(
      printed["command"],
      "gearlash simulate --until 12 --every 0.5 --format json --restitution 0.3 --reference 1 "
      "--damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3");
}

/// B1 of the first version: adding a limit that is never reached changed units and keys.
TEST(SimulateCommand, BothEnginesWriteTheSameTables) {
  const auto printed = [](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", "examples/elinco-fd162.toml", "--until", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_tool(words).out;
  };
  const std::string limit = "motor.voltage_limit=1e9 V";
  for (const char* format : {"csv", "json"}) {
    const std::string one = printed({"--format", format});
    const std::string other = printed({"--format", format, "--set", limit});
    if (std::string(format) == "csv") {
      EXPECT_EQ(lines_of(one)[0], lines_of(other)[0]);
      EXPECT_EQ(lines_of(one).size(), lines_of(other).size());
      continue;
    }
    const json first = json::parse(one);
    const json second = json::parse(other);
    EXPECT_EQ(second["engine"], "general");
    for (const auto& [key, value] : first.items()) EXPECT_TRUE(second.contains(key)) << key;
    EXPECT_EQ(first["samples"]["columns"], second["samples"]["columns"]);
    ASSERT_EQ(first["events"].size(), second["events"].size());
    for (std::size_t i = 0; i < first["events"].size(); ++i) {
      EXPECT_EQ(first["events"][i]["what"], second["events"][i]["what"]);
    }
  }
}

TEST(SimulateCommand, AMotionCutShortIsPrintedAsFarAsItIsKnown) {
  const test::Scratch scratch;
  const std::string events = (scratch / "events.csv").string();
  const Outcome run =
      run_tool(with_sample_servo({"simulate", "--until", "1e8", "--events", "--output", events}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, testing::MatchesRegex(
                           "gearlash: stopped at .* s of 1e.08 s: after 1000000 events\n"));
  std::ifstream stream(events);
  std::string line;
  std::size_t rows = 0;
  while (std::getline(stream, line)) ++rows;
  EXPECT_EQ(rows, 1'000'001U);  // with the names of the columns
}

TEST(SimulateCommand, TimesAnglesAndSpeedsMayCarryTheirUnit) {
  const Table table =
      table_of(run_tool({"simulate", "examples/elinco-fd162.toml", "--until", "50 ms", "--every",
                         "25 ms", "--initial-position", "180 deg", "--initial-speed", "60 rpm"}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_DOUBLE_EQ(number(table.rows[2][0]), 0.05);
  EXPECT_DOUBLE_EQ(number(table.rows[0][1]), std::numbers::pi);
  EXPECT_DOUBLE_EQ(number(table.rows[0][2]), 2.0 * std::numbers::pi);
}

/// That of the file, or of the option where the file has radians.
TEST(SimulateCommand, PicturesAreInTheUnitOfTheAuthor) {
  const test::Scratch scratch;
  const std::string picture = (scratch / "step.svg").string();
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", "--plot", "time=" + picture, "--output",
                                      "/dev/null"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome run = run_tool(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return test::file_text(picture);
  };
  EXPECT_THAT(drawn(with_sample_servo({})), HasSubstr("position (rad)"));
  EXPECT_THAT(drawn(with_sample_servo({"--reference", "30 deg"})), HasSubstr("position (deg)"));
  EXPECT_THAT(drawn({"examples/telescope-axis.toml", "--until", "1"}),
              HasSubstr("position (arcmin)"));
  EXPECT_THAT(drawn({"examples/elinco-fd162.toml", "--until", "1"}), HasSubstr("hunts: ±"));
}

TEST(SimulateCommand, ShaftsMayStartApart) {
  const Table table = table_of(run_tool(
      with_sample_servo({"simulate", "--until", "1", "--initial-position", "0.5", "--initial-speed",
                         "0.25", "--initial-gap", "0.01", "--initial-gap-speed", "-0.5"})));
  EXPECT_DOUBLE_EQ(number(table.rows[0][1]), 0.5);
  EXPECT_DOUBLE_EQ(number(table.rows[0][2]), 0.25);
  EXPECT_DOUBLE_EQ(number(table.rows[0][3]), 0.51);
  EXPECT_DOUBLE_EQ(number(table.rows[0][4]), -0.25);
  const Outcome run =
      run_tool(with_sample_servo({"simulate", "--until", "1", "--initial-gap", "2"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--initial-gap = 2: must be from -0.15 to 0.15 rad"));
}

TEST(SimulateCommand, TheLongestTimeIsToldInItsUnit) {
  const Outcome run = run_tool({"simulate", "examples/elinco-fd162.toml", "--until", "1e300"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::MatchesRegex(
                           "gearlash: --until = 1e300: must be at most .* s, and not negative\n"));
}

}  // namespace
}  // namespace gearlash::simulate_command_test
