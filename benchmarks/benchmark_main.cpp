// Gearlash beside Boost.odeint and SUNDIALS CVODE: every contestant does the same problems in this
// one process, its answers are checked against ours, and the table of ratios is printed at the end;
// then many servos at once, how far that is from what the machine can do, and how it scales; a map
// from command to file; charts for programs; what must change; and the engine for hybrid systems.
// Options are Google Benchmark's; the tables go to standard output in Markdown, the rest to
// standard error.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "contestants.hpp"
#include "design_race.hpp"
#include "fastest_times.hpp"
#include "floor.hpp"
#include "grid_race.hpp"
#include "hybrid_race.hpp"
#include "kernel_alone.hpp"
#include "map_of_searched.hpp"
#include "map_to_file.hpp"
#include "scaling.hpp"

namespace {

using namespace gearlash::benchmarks;

struct Accuracy {
  double amplitude = 0.0;    ///< worst relative difference from ours
  double period = 0.0;       ///< likewise
  double half_cycles = 0.0;  ///< mean, to convergence
  bool complete = true;      ///< every problem converged
};

/// One line of the report: a contestant on one list of problems.
struct Entry {
  std::string benchmark;
  Contestant contestant;
  std::size_t problems;
  Accuracy accuracy;
};

struct Race {
  std::string title;
  std::vector<Entry> entries;
};

Accuracy check(const Task& task, const std::vector<Problem>& problems) {
  Accuracy accuracy;
  std::vector<RivalCycle> answers(problems.size());
  task(answers);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const RivalCycle& found = answers[i];
    const auto& cycle = problems[i].cycle;
    accuracy.amplitude =
        std::max(accuracy.amplitude, std::abs(found.amplitude / cycle.amplitude - 1.0));
    accuracy.period = std::max(accuracy.period, std::abs(found.period / cycle.period - 1.0));
    accuracy.half_cycles +=
        static_cast<double>(found.half_cycles) / static_cast<double>(problems.size());
    accuracy.complete = accuracy.complete && found.converged;
  }
  return accuracy;
}

Race enter(const std::string& title, const std::vector<Contestant>& contestants,
           const std::vector<Problem>& problems) {
  Race race{title, {}};
  for (const Contestant& contestant : contestants) {
    const Task task = contestant.prepare(problems);
    const std::string name = title + "/" + contestant.name;
    race.entries.push_back({name, contestant, problems.size(), check(task, problems)});
    benchmark::RegisterBenchmark(name.c_str(), [task,
                                                count = problems.size()](benchmark::State& state) {
      std::vector<RivalCycle> answers(count);
      for (auto _ : state) {
        task(answers);
        benchmark::DoNotOptimize(answers.data());
        benchmark::ClobberMemory();
      }
    })->Unit(benchmark::kMicrosecond);
  }
  return race;
}

void print_race(const Race& race, const FastestTimes& times) {
  std::printf("\n**%s** (%zu problems)\n\n", race.title.c_str(), race.entries.front().problems);
  const auto microseconds = [&](const Entry& entry) {
    return times.of(entry.benchmark) * 1e6 / static_cast<double>(entry.problems);
  };
  std::vector<double> yardsticks;
  std::printf("| | one problem, µs |");
  for (const Entry& entry : race.entries) {
    if (!entry.contestant.yardstick) continue;
    yardsticks.push_back(microseconds(entry));
    std::printf(" times %s |", entry.contestant.name.c_str());
  }
  std::printf(" worst error: amplitude, period | half cycles |\n|---|--:|");
  for (std::size_t i = 0; i < yardsticks.size(); ++i) std::printf("--:|");
  std::printf("--:|--:|\n");
  for (const Entry& entry : race.entries) {
    const double time = microseconds(entry);
    if (std::isnan(time)) continue;
    std::printf("| %s | %.3f |", entry.contestant.name.c_str(), time);
    for (const double yardstick : yardsticks) std::printf(" %.3g |", time / yardstick);
    std::printf(" %.1e, %.1e%s | %.0f |\n", entry.accuracy.amplitude, entry.accuracy.period,
                entry.accuracy.complete ? "" : " (did not converge)", entry.accuracy.half_cycles);
  }
}

std::vector<Race> all_races() {
  const std::vector<Problem> plastic = thesis_problems(0.0);
  const std::vector<Problem> bouncing = thesis_problems(0.3);
  std::vector<Race> races;
  const auto add = [&](const char* title, const auto& contestants, const auto& problems) {
    if (!problems.empty()) races.push_back(enter(title, contestants, problems));
  };
  add("Limit cycle, rivals from rest", limit_cycle_contestants(Start::from_rest, Contact::plastic),
      plastic);
  add("Limit cycle, rivals from 1 % off our cycle",
      limit_cycle_contestants(Start::near_cycle, Contact::plastic), plastic);
  add("Limit cycle with restitution 0.3, rivals from rest",
      limit_cycle_contestants(Start::from_rest, Contact::bouncing), bouncing);
  add("Half cycle", half_cycle_contestants(), plastic);
  add("Half cycle with restitution 0.3", half_cycle_contestants(), bouncing);
  return races;
}

}  // namespace

int main(int argc, char** argv) {
  // Interleaved, so that no contestant has a busy neighbour on the machine for all its repetitions.
  std::vector<std::string> words = {argv[0], "--benchmark_min_time=0.2",
                                    "--benchmark_repetitions=5",
                                    "--benchmark_enable_random_interleaving=true"};
  words.insert(words.end(), argv + 1, argv + argc);  // the user's own come later and prevail
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  const std::vector<Race> races = all_races();
  const std::vector<ReportPart> parts = {
      enter_grid_race(),   enter_floor(),       enter_kernel_alone(), enter_scaling(),
      enter_map_to_file(), enter_design_race(), enter_hybrid_race(),  enter_map_of_searched()};
  FastestTimes times;
  benchmark::RunSpecifiedBenchmarks(&times);
  std::printf(
      "Processor time on one core, the fastest of the repetitions; rivals at tolerance "
      "%.0e, cycles converged to %.0e (with restitution %.0e).\n",
      rival_tolerance, cycle_tolerance, bouncing_cycle_tolerance);
  for (const Race& race : races) print_race(race, times);
  for (const ReportPart& print : parts) print(times);
  return 0;
}
