// design_drives: random tasks of design for industrial drives, put back into the drives. A line for
// each that does not hold, and a summary. Exit status 1 where an end misses its target or an
// interval as wide as the grid's distance was missed.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "design_task.hpp"

namespace {

using gearlash::oracle::DesignCheck;
using gearlash::oracle::DesignTask;

struct Settings {
  std::uint64_t first = 1;
  std::uint64_t count = 300;
  bool all_lines = false;
};

struct Totals {
  std::size_t tasks = 0, answered = 0, values = 0, judged = 0;
  std::size_t ends = 0, inner = 0, missed = 0;
};

void print(const char* title, const std::vector<double>& values) {
  if (values.empty()) return;
  std::printf(" | %s", title);
  for (const double value : values) std::printf(" %.17g", value);
}

void print(std::uint64_t seed, const DesignTask& task, const DesignCheck& check, double seconds) {
  std::printf("seed %llu | %s |", static_cast<unsigned long long>(seed), task.text.c_str());
  for (const gearlash::Bounds& interval : check.found.intervals) {
    std::printf(" %.6g ... %.6g", interval.low, interval.high);
  }
  if (!check.found.undecided.empty()) {
    std::printf(" (%zu undecided)", check.found.undecided.size());
  }
  std::printf(" | %zu + %zu analyses, %.1f s", check.found.evaluations, check.judged, seconds);
  print("ENDS THAT MISS", check.ends_that_miss);
  print("inside, missing", check.inner_that_miss);
  print("INTERVALS MISSED", check.missed);
  std::printf("\n");
  std::fflush(stdout);
}

int design(const Settings& settings) {
  Totals totals;
  for (std::uint64_t seed = settings.first; seed < settings.first + settings.count; ++seed) {
    const auto start = std::chrono::steady_clock::now();
    const DesignTask task = gearlash::oracle::random_design_task(seed);
    const DesignCheck check = gearlash::oracle::checked_design(task);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ++totals.tasks;
    totals.answered += check.found.intervals.empty() ? 0U : 1U;
    totals.values += check.values_in_intervals;
    totals.judged += check.judged;
    totals.ends += check.ends_that_miss.size();
    totals.inner += check.inner_that_miss.size();
    totals.missed += check.missed.size();
    const bool holds =
        check.ends_that_miss.empty() && check.inner_that_miss.empty() && check.missed.empty();
    if (!holds || settings.all_lines) print(seed, task, check, took.count());
  }
  std::printf(
      "tasks: %zu, with values that meet the target: %zu\n"
      "values put back: %zu; ends that miss: %zu; within, narrower than the grid: %zu\n"
      "intervals missed: %zu; drives analysed for the check: %zu\n",
      totals.tasks, totals.answered, totals.values, totals.ends, totals.inner, totals.missed,
      totals.judged);
  return totals.ends + totals.missed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Random tasks of design for industrial drives, put back into the drives"};
  app.add_option("--first", settings.first, "seed of the first task")->capture_default_str();
  app.add_option("--count", settings.count, "number of tasks")->capture_default_str();
  app.add_flag("--all-lines", settings.all_lines, "print the tasks that hold too");
  CLI11_PARSE(app, argc, argv);
  try {
    return design(settings);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "design_drives: %s\n", failure.what());
    return 2;
  }
}
