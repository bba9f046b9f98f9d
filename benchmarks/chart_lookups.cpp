#include "chart_lookups.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "analysis/grid/axis.hpp"
#include "gearlash/chart.hpp"

namespace gearlash::benchmarks {
namespace {

constexpr double tolerance = 1e-3;
constexpr Quantity quantity = Quantity::amplitude;

Axis damping_axis(std::size_t count) {
  return spaced_axis("damping", "servo.damping", 0.05, 0.7, count, Spacing::linear);
}
Axis inertia_axis(std::size_t count) {
  return spaced_axis("inertia_ratio", "servo.inertia_ratio", 1.0 / 9.0, 9.0, count,
                     Spacing::logarithmic);
}
Axis friction_axis(std::size_t count) {
  return spaced_axis("friction_ratio", "servo.friction_ratio", 0.05, 0.95, count, Spacing::linear);
}

struct ChartTask {
  std::string name;
  Grid grid;
};

std::vector<ChartTask> chart_tasks() {
  const Drive thesis = normal_form(0.1, 1.0, 0.1, 0.3);
  std::vector<ChartTask> tasks = {
      {"inertia ratio, 100", {.drive = thesis, .axes = {inertia_axis(100)}}},
      {"inertia ratio × friction ratio, 100 × 100",
       {.drive = thesis, .axes = {inertia_axis(100), friction_axis(100)}}}};
  for (const std::size_t count : {20U, 100U, 300U}) {
    const std::string number = std::to_string(count);
    tasks.push_back({"damping × inertia ratio, " + number + " × " + number,
                     {.drive = thesis, .axes = {damping_axis(count), inertia_axis(count)}}});
  }
  tasks.push_back(
      {"damping × inertia ratio × friction ratio, 50 × 50 × 50",
       {.drive = thesis, .axes = {damping_axis(50), inertia_axis(50), friction_axis(50)}}});
  return tasks;
}

using Places = std::vector<std::vector<double>>;

/// Anywhere on the chart, evenly as its axes are spaced.
Places random_places(const Grid& grid) {
  constexpr std::uint64_t seed = 1960;
  constexpr std::size_t count = 20'000;
  std::mt19937_64 engine(seed);
  Places places(count);
  for (std::vector<double>& place : places) {
    for (const Axis& axis : grid.axes) {
      place.push_back(value_at(axis, static_cast<double>(engine() >> 11) * 0x1p-53));
    }
  }
  return places;
}

/// Those of them whose answer comes from there.
Places places_of(const DesignChart& chart, const Places& places, ChartSource source) {
  Places chosen;
  for (const std::vector<double>& place : places) {
    if (chart.look_up(place).source == source) chosen.push_back(place);
  }
  return chosen;
}

/// A line of the table.
struct Entry {
  std::string name;
  ChartAccuracy accuracy;
  std::string building;  ///< the names of the benchmarks
  std::string interpolated;
  std::string solved;
  std::size_t interpolated_places;
  std::size_t solved_places;
};

/// By the clock, for all cores build.
void enter_building(const std::string& name, const Grid& grid) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [grid](benchmark::State& state) {
                                 for (auto _ : state) {
                                   const DesignChart chart(grid, quantity,
                                                           {.tolerance = tolerance});
                                   benchmark::DoNotOptimize(chart.accuracy().stated_error);
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.05);
}

void enter_lookups(const std::string& name, const std::shared_ptr<const DesignChart>& chart,
                   const Places& places) {
  if (places.empty()) return;
  benchmark::RegisterBenchmark(name.c_str(),
                               [chart, places](benchmark::State& state) {
                                 for (auto _ : state) {
                                   for (const std::vector<double>& place : places) {
                                     benchmark::DoNotOptimize(chart->look_up(place).value);
                                   }
                                 }
                               })
      ->Unit(benchmark::kMicrosecond)
      ->MinTime(0.05);
}

Entry enter(const ChartTask& task) {
  const auto chart =
      std::make_shared<const DesignChart>(task.grid, quantity, DesignChartOptions{tolerance});
  const Places places = random_places(task.grid);
  const Places interpolated = places_of(*chart, places, ChartSource::interpolated);
  const Places solved = places_of(*chart, places, ChartSource::solved);
  const std::string title = "Charts/" + task.name;
  const Entry entry{task.name,           chart->accuracy(),  title + ", building",
                    title + ", between", title + ", solved", interpolated.size(),
                    solved.size()};
  enter_building(entry.building, task.grid);
  enter_lookups(entry.interpolated, chart, interpolated);
  enter_lookups(entry.solved, chart, solved);
  return entry;
}

std::string nanoseconds_each(double seconds, std::size_t places) {
  if (std::isnan(seconds)) return "none";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", 1e9 * seconds / static_cast<double>(places));
  return text;
}

void print(const Entry& entry, const FastestTimes& times) {
  const double building = times.of(entry.building);
  if (std::isnan(building)) return;
  const ChartAccuracy& accuracy = entry.accuracy;
  std::printf("| %s | %zu | %.1e | %.1e | %.1e | %.3g | %.3g | %s | %s |\n", entry.name.c_str(),
              accuracy.checked_points, accuracy.largest_error, accuracy.typical_error,
              accuracy.stated_error, 100.0 * accuracy.solved_share, 1e3 * building,
              nanoseconds_each(times.of(entry.interpolated), entry.interpolated_places).c_str(),
              nanoseconds_each(times.of(entry.solved), entry.solved_places).c_str());
}

}  // namespace

ReportPart enter_chart_lookups() {
  std::vector<Entry> entries;
  for (const ChartTask& task : chart_tasks()) entries.push_back(enter(task));
  return [entries](const FastestTimes& times) {
    std::printf("\n**Charts for programs** (amplitude, tolerance %.0e)\n\n", tolerance);
    std::printf(
        "| axes, values | checked points | largest error found | median of the cells | stated, at "
        "most | cells solved, %% | to build, ms | lookup between values, ns | lookup solved, ns |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const Entry& entry : entries) print(entry, times);
  };
}

}  // namespace gearlash::benchmarks
