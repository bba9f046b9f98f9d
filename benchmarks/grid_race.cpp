#include "grid_race.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "contestants.hpp"
#include "servo_lists.hpp"

namespace gearlash::benchmarks {
namespace {

constexpr const char* grid_title = "Thesis's grid";
constexpr const char* draw_title = "Wide draw";

std::string batch_name(const std::string& title, VectorUnit unit) {
  return title + "/find_limit_cycles(), " + name_of(unit);
}

/// A line of the table.
struct Entry {
  std::string benchmark;
  std::string name;
  std::size_t servos;  ///< that it was measured on
  std::string answers;
};

struct GridRace {
  std::string title;
  std::string about;
  std::vector<Entry> entries;  ///< ours with the widest unit last, then all others
  std::size_t yardstick = 0;
};

/// Every so-many-th, some `count` in all.
template <class Item>
std::vector<Item> sample_of(const std::vector<Item>& items, std::size_t count) {
  std::vector<Item> sample;
  const std::size_t stride = std::max<std::size_t>(1, items.size() / count);
  for (std::size_t i = stride / 2; i < items.size(); i += stride) sample.push_back(items[i]);
  return sample;
}

std::string text(const char* format, double first, double second) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, first, second);
  return buffer;
}

/// Side by side, with each unit; each race has as many as the machine has units.
void enter_units(GridRace& race,
                 const std::shared_ptr<const std::vector<NormalizedServo>>& servos) {
  for (const VectorUnit unit : available_vector_units()) {
    const std::string name = batch_name(race.title, unit);
    auto table = std::make_shared<Table>(table_of(servos->size()));
    const BatchCount count = find_limit_cycles(*servos, columns_of(*table), unit);
    const double all = static_cast<double>(servos->size());
    const auto hunting =
        std::count(table->verdicts().begin(), table->verdicts().end(), Verdict::hunts);
    race.about =
        text("%.0f servos, of which %.1f %% hunt", all, 100.0 * static_cast<double>(hunting) / all);
    race.entries.push_back({name, std::string("Gearlash, find_limit_cycles(), ") + name_of(unit),
                            servos->size(),
                            text("every property; %.1f %% solved one by one",
                                 100.0 * static_cast<double>(count.one_by_one) / all, 0.0)});
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
      for (auto _ : state) {
        benchmark::DoNotOptimize(find_limit_cycles(*servos, columns_of(*table), unit));
      }
    })->Unit(benchmark::kMillisecond);
  }
  race.yardstick = race.entries.size() - 1;
}

void enter_one_by_one(GridRace& race, const std::vector<NormalizedServo>& servos) {
  const std::vector<NormalizedServo> sample = sample_of(servos, 5'000);
  const std::string name = race.title + "/analyse_limit_cycles()";
  race.entries.push_back(
      {name, "Gearlash, analyse_limit_cycles()", sample.size(), "every property"});
  benchmark::RegisterBenchmark(name.c_str(), [sample](benchmark::State& state) {
    for (auto _ : state) {
      for (const NormalizedServo& servo : sample) {
        benchmark::DoNotOptimize(analyse_limit_cycles(servo).growth_at_rest);
      }
    }
  })->Unit(benchmark::kMillisecond);
}

/// Those that hunt, with a growth at rest not next to 1: a rival that follows a servo to rest never
/// comes to an end, and one next to the boundary hardly.
std::vector<Problem> hunting_sample(const std::vector<NormalizedServo>& servos) {
  constexpr std::size_t count = 48;
  constexpr double clearly_hunting = 1.2;
  std::vector<Problem> problems;
  for (const NormalizedServo& servo : sample_of(servos, 20 * count)) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    if (analysis.growth_at_rest < clearly_hunting) continue;
    problems.push_back({servo, analysis.cycles.front()});
  }
  return sample_of(problems, count);
}

std::string accuracy_of(const std::vector<RivalCycle>& answers,
                        const std::vector<Problem>& problems) {
  double worst = 0.0;
  double unsettled = 0.0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i].converged) {
      ++unsettled;
      continue;
    }
    worst = std::max(worst, std::abs(answers[i].amplitude / problems[i].cycle.amplitude - 1.0));
  }
  return text("amplitude and period; amplitude within %.1e, %.0f did not settle", worst, unsettled);
}

void enter_rivals(GridRace& race, const std::vector<Problem>& problems) {
  for (const Contestant& rival : settling_contestants()) {
    const Task task = rival.prepare(problems);
    std::vector<RivalCycle> answers(problems.size());
    task(answers);
    const std::string name = race.title + "/" + rival.name;
    race.entries.push_back({name, rival.name, problems.size(), accuracy_of(answers, problems)});
    benchmark::RegisterBenchmark(name.c_str(),
                                 [task, answers](benchmark::State& state) mutable {
                                   for (auto _ : state) {
                                     task(answers);
                                     benchmark::DoNotOptimize(answers.data());
                                   }
                                 })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->Repetitions(3);
  }
}

void print(const GridRace& race, const FastestTimes& times) {
  const auto seconds = [&](const Entry& entry) {
    return times.of(entry.benchmark) / static_cast<double>(entry.servos);
  };
  const Entry& yardstick = race.entries[race.yardstick];
  std::printf("\n**%s** (%s)\n\n", race.title.c_str(), race.about.c_str());
  std::printf(
      "| | measured on | a servo, µs | servos a second | times the widest unit | answers |\n");
  std::printf("|---|--:|--:|--:|--:|---|\n");
  for (const Entry& entry : race.entries) {
    const double time = seconds(entry);
    if (std::isnan(time)) continue;
    std::printf("| %s | %zu | %.3g | %.3g | %.3g | %s |\n", entry.name.c_str(), entry.servos,
                time * 1e6, 1.0 / time, time / seconds(yardstick), entry.answers.c_str());
  }
}

GridRace enter(const char* title, std::vector<NormalizedServo> list) {
  const auto servos = std::make_shared<const std::vector<NormalizedServo>>(std::move(list));
  GridRace race{title, {}, {}};
  enter_units(race, servos);
  enter_one_by_one(race, *servos);
  return race;
}

}  // namespace

std::string name_of_grid_benchmark(VectorUnit unit) { return batch_name(grid_title, unit); }

ReportPart enter_grid_race() {
  const std::vector<NormalizedServo> grid = servos_of(thesis_grid());
  GridRace on_grid = enter(grid_title, grid);
  enter_rivals(on_grid, hunting_sample(grid));
  const GridRace on_draw = enter(draw_title, wide_draw());
  return [=](const FastestTimes& times) {
    print(on_grid, times);
    print(on_draw, times);
  };
}

}  // namespace gearlash::benchmarks
