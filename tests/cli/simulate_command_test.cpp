// gearlash simulate: tables that read back as exactly the trajectory of the library.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "input/servo_file.hpp"
#include "output/motion_report.hpp"
#include "tool.hpp"

namespace gearlash {
namespace {

using nlohmann::json;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::with_sample_servo;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const NormalizedServo sample_servo{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

struct Table {
  std::vector<std::string> provenance;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

Table table_of(const Outcome& run) {
  EXPECT_EQ(run.status, 0) << run.err;
  Table table;
  for (const std::string& line : lines_of(run.out)) {
    if (line.starts_with("#")) {
      table.provenance.push_back(line);
    } else if (table.columns.empty()) {
      table.columns = cells_of(line);
    } else {
      table.rows.push_back(cells_of(line));
    }
  }
  return table;
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

void expect_state(const std::vector<std::string>& row, std::size_t first, const ServoState& state,
                  double speed_unit) {
  EXPECT_EQ(number(row.at(first)), state.load_position);
  EXPECT_EQ(number(row.at(first + 1)), state.load_speed * speed_unit);
  EXPECT_EQ(number(row.at(first + 2)), state.motor_position);
  EXPECT_EQ(number(row.at(first + 3)), state.motor_speed * speed_unit);
}

TEST(SimulateCommand, CsvReadsBackAsExactlyTheTrajectory) {
  const Table table = table_of(run_tool(
      with_sample_servo({"simulate", "--until", "20", "--every", "0.07", "--initial-position",
                         "0.5", "--initial-speed", "-1/3", "--reference", "0.25"})));
  EXPECT_THAT(table.columns,
              ElementsAre("time_normalized", "load_position_rad", "load_speed_normalized_rad",
                          "motor_position_rad", "motor_speed_normalized_rad", "mode"));
  const Trajectory trajectory =
      simulate(sample_servo, engaged_start(sample_servo, 0.5, -1.0 / 3.0, 0.25),
               {.until = 20.0, .reference = 0.25});
  ASSERT_EQ(table.rows.size(), 286U);
  for (const auto& row : table.rows) {
    const double time = number(row[0]);
    expect_state(row, 1, trajectory.at(time), 1.0);
    EXPECT_EQ(row[5], name_of(trajectory.mode_at(time)));
  }
}

TEST(SimulateCommand, TimesOfSamplesAreWrittenAsTheStepIs) {
  const Table table =
      table_of(run_tool(with_sample_servo({"simulate", "--until", "0.03", "--every", "0.003"})));
  ASSERT_EQ(table.rows.size(), 11U);
  EXPECT_EQ(table.rows[3][0], "0.009");
  EXPECT_EQ(table.rows[10][0], "0.03");
}

TEST(SimulateCommand, ProvenanceSaysHowToMakeTheFileAgain) {
  const Table table = table_of(run_tool(with_sample_servo({"simulate", "--until", "1"})));
  EXPECT_THAT(table.provenance, Contains(StartsWith("# gearlash 0.")));
  EXPECT_THAT(table.provenance,
              Contains("# command: gearlash simulate --until 1 --damping 0.19 --inertia-ratio 2 "
                       "--friction-ratio 1/10 --backlash 0.3"));
  EXPECT_THAT(table.provenance, Contains(HasSubstr("friction_ratio = 0.1, backlash = 0.3 rad")));
  EXPECT_THAT(table.provenance, Contains(HasSubstr("normalized, in units of 1/omega_n")));
}

TEST(SimulateCommand, ADataSheetIsTimedInSeconds) {
  const Table table = table_of(run_tool({"simulate", "examples/elinco-fd162.toml", "--until", "0.5",
                                         "--every", "0.125", "--initial-speed", "2"}));
  const ServoFile file =
      read_servo_file(std::string(GEARLASH_SOURCE_DIRECTORY) + "/examples/elinco-fd162.toml");
  const double frequency = *file.natural_frequency;
  const Trajectory trajectory =
      simulate(file.servo, engaged_start(file.servo, 0.0, 2.0 / frequency, 1.0),
               {.until = 0.5 * frequency, .reference = 1.0});
  EXPECT_THAT(table.columns, ElementsAre("time_s", "load_position_rad", "load_speed_rad_per_s",
                                         "motor_position_rad", "motor_speed_rad_per_s", "mode"));
  ASSERT_EQ(table.rows.size(), 5U);
  for (const auto& row : table.rows) {
    expect_state(row, 1, trajectory.at(number(row[0]) * frequency), frequency);
  }
}

TEST(SimulateCommand, RunsTenNaturalPeriodsInAThousandStepsByDefault) {
  const Table table = table_of(run_tool(with_sample_servo({"simulate"})));
  ASSERT_EQ(table.rows.size(), 1001U);
  EXPECT_NEAR(number(table.rows.back()[0]), 20.0 * std::numbers::pi, 1e-9);
}

TEST(SimulateCommand, EventsReadBackExactly) {
  for (const char* restitution : {"0", "0.6"}) {
    const Table table = table_of(run_tool(with_sample_servo(
        {"simulate", "--until", "30", "--events", "--restitution", restitution})));
    NormalizedServo servo = sample_servo;
    servo.restitution = number(restitution);
    const Trajectory trajectory =
        simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 30.0, .reference = 1.0});
    ASSERT_EQ(table.rows.size(), trajectory.events().size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Event& event = trajectory.events()[i];
      const auto& row = table.rows[i];
      EXPECT_EQ(number(row[0]), event.time);
      EXPECT_EQ(row[1], name_of(event.kind));
      EXPECT_EQ(row[2], name_of(event.face));
      EXPECT_EQ(row[3], name_of(event.mode_after));
      EXPECT_EQ(number(row[4]), event.energy_lost);
      expect_state(row, 5, event.before, 1.0);
      expect_state(row, 9, event.after, 1.0);
    }
  }
}

TEST(SimulateCommand, JsonHoldsSamplesEventsBooksAndStopReason) {
  const Outcome run = run_tool(with_sample_servo(
      {"simulate", "--until", "12", "--every", "0.5", "--format", "json", "--restitution", "0.3"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const json printed = json::parse(run.out);
  NormalizedServo servo = sample_servo;
  servo.restitution = 0.3;
  const Trajectory trajectory =
      simulate(servo, engaged_start(servo, 0.0, 0.0, 1.0), {.until = 12.0, .reference = 1.0});
  EXPECT_EQ(printed["stop_reason"], "reached_end");
  EXPECT_EQ(printed["events"].size(), trajectory.events().size());
  EXPECT_EQ(printed["events"].back()["time"].get<double>(), trajectory.events().back().time);
  EXPECT_EQ(printed["events"].back()["after"]["motor_speed"].get<double>(),
            trajectory.events().back().after.motor_speed);
  EXPECT_EQ(printed["samples"]["columns"][1], "load_position");
  ASSERT_EQ(printed["samples"]["rows"].size(), 25U);
  for (const json& row : printed["samples"]["rows"]) {
    EXPECT_EQ(row[1].get<double>(), trajectory.at(row[0].get<double>()).load_position);
  }
}

TEST(SimulateCommand, EnergyBooksBalance) {
  const Outcome run = run_tool({"simulate", "examples/elinco-fd162.toml", "--format", "json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json energy = json::parse(run.out)["energy"];
  const auto entry = [&](const char* key) { return energy[key].get<double>(); };
  const double in = entry("stored_at_start") + entry("supplied");
  const double out =
      entry("stored") + entry("motor_friction") + entry("load_friction") + entry("impacts");
  // Sums of some ten segments each, by quadrature to a double's last digits.
  EXPECT_NEAR(in, out, 1e-12 * in);
  EXPECT_GT(entry("impacts"), 0.0);
}

TEST(SimulateCommand, AMotionCutShortIsPrintedAsFarAsItIsKnown) {
  const test::Scratch scratch;
  const std::string events = (scratch / "events.csv").string();
  const Outcome run =
      run_tool(with_sample_servo({"simulate", "--until", "1e8", "--events", "--output", events}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err,
              testing::MatchesRegex("gearlash: stopped at .* of 1e.08 after 1000000 events\n"));
  std::ifstream stream(events);
  std::string line;
  std::size_t rows = 0;
  while (std::getline(stream, line)) rows += line.starts_with("#") ? 0U : 1U;
  EXPECT_EQ(rows, 1'000'001U);  // with the names of the columns
}

TEST(SimulateCommand, AnglesMayCarryTheirUnit) {
  const Table table = table_of(
      run_tool(with_sample_servo({"simulate", "--until", "1", "--initial-position", "180 deg"})));
  EXPECT_DOUBLE_EQ(number(table.rows[0][1]), std::numbers::pi);
}

TEST(SimulateCommand, TimesAndSpeedsMayCarryTheirUnitWhereThereIsASecond) {
  const Table table =
      table_of(run_tool({"simulate", "examples/elinco-fd162.toml", "--until", "50 ms", "--every",
                         "25 ms", "--initial-speed", "60 rpm"}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_DOUBLE_EQ(number(table.rows[2][0]), 0.05);
  EXPECT_DOUBLE_EQ(number(table.rows[0][2]), 2.0 * std::numbers::pi);
  const Outcome run = run_tool(with_sample_servo({"simulate", "--until", "50 ms"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --until = 50 ms: must be a number, in 1/ω_n: the servo has no "
            "natural_frequency to go by\n");
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
  EXPECT_THAT(run.err, testing::MatchesRegex("gearlash: --until = 1e300: must be at most .* s\n"));
}

}  // namespace
}  // namespace gearlash
