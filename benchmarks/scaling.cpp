#include "scaling.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>

#include "servo_lists.hpp"
#include "vector_functions.hpp"

namespace gearlash::benchmarks {
namespace {

/// All cores are seldom idle together: many short repetitions find such a moment.
constexpr int often = 20;

/// A line of the table.
struct Entry {
  std::string name;
  std::string benchmark;
  std::size_t points;
};

std::string cores_text(std::size_t cores) {
  return std::to_string(cores) + (cores == 1 ? " core" : " cores");
}

/// By the clock, for the work is done on other threads than the one that measures.
Entry enter(const std::string& name, const Grid& grid, const Workers& how) {
  const std::string title = "Scaling/" + name;
  auto table = std::make_shared<Table>(table_of(grid.size()));
  const Family family(grid);
  benchmark::RegisterBenchmark(
      title.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) {
          benchmark::DoNotOptimize(evaluate(family, grid, 0, *table, no_progress(), how));
        }
      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.05)
      ->Repetitions(often);
  return {name, title, grid.size()};
}

/// The same servos, made beforehand.
Entry enter_list(const std::string& name, const std::vector<NormalizedServo>& servos) {
  const std::string title = "Scaling/" + name + ", as a list";
  auto table = std::make_shared<Table>(table_of(servos.size()));
  benchmark::RegisterBenchmark(
      title.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) {
          benchmark::DoNotOptimize(find_limit_cycles(servos, columns_of(*table)));
        }
      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.05)
      ->Repetitions(often);
  return {name, title, servos.size()};
}

/// About a hundred thousand points on so many axes, in the order that maps have them. The fifth,
/// the restitution, has the one value 0: with bounces every servo is solved alone.
Grid grid_of_axes(std::size_t count) {
  constexpr std::size_t lengths[][5] = {{100'000, 0, 0, 0, 0},
                                        {316, 316, 0, 0, 0},
                                        {46, 46, 47, 0, 0},
                                        {18, 18, 18, 17, 0},
                                        {18, 18, 18, 17, 1}};
  const auto& length = lengths[count - 1];
  Grid grid{.drive = normal_form(0.1, 1.0, 0.5, 0.3), .axes = {}};
  const auto add = [&](const char* path, double from, double to, Spacing spacing) {
    const std::size_t axis = grid.axes.size();
    if (axis == count) return;
    grid.axes.push_back(spaced_axis(path, path, from, to, length[axis], spacing));
  };
  add("servo.friction_ratio", 0.04, 0.6, Spacing::linear);
  add("servo.damping", 0.05, 0.5, Spacing::linear);
  add("servo.inertia_ratio", 1.0 / 9.0, 9.0, Spacing::logarithmic);
  add("servo.backlash", 0.1, 0.3, Spacing::linear);
  add("contact.restitution", 0.0, 0.0, Spacing::linear);
  return grid;
}

/// What the machine's cores do of work that shares nothing: exponentials, in columns that stay in
/// each core's nearest cache.
Entry enter_exponentials(std::size_t threads) {
  constexpr std::size_t columns = 20'000;
  const ColumnFunction exponential =
      column_functions(widest_vector_unit())[static_cast<std::size_t>(Operation::exponential)];
  const auto work = [=] {
    alignas(64) double x[column_length] = {};
    alignas(64) double result[column_length];
    for (std::size_t i = 0; i < columns; ++i) {
      exponential(x, x, result);
      benchmark::ClobberMemory();
    }
    benchmark::DoNotOptimize(result[0]);
  };
  const std::string name = cores_text(threads) + ", exponentials, " + name_of(widest_vector_unit());
  const std::string title = "Scaling/" + name;
  benchmark::RegisterBenchmark(title.c_str(),
                               [=](benchmark::State& state) {
                                 for (auto _ : state) {
                                   std::vector<std::thread> others;
                                   for (std::size_t i = 1; i < threads; ++i)
                                     others.emplace_back(work);
                                   work();
                                   for (std::thread& other : others) other.join();
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.05)
      ->Repetitions(often);
  return {name, title, threads * columns * column_length};
}

/// 1, 2, 4, … and all.
std::vector<std::size_t> numbers_of_cores() {
  const std::size_t all = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::size_t> numbers;
  for (std::size_t cores = 1; cores < all; cores *= 2) numbers.push_back(cores);
  numbers.push_back(all);
  return numbers;
}

struct Entries {
  std::vector<Entry> lanes;
  std::vector<Entry> cores;
  std::vector<Entry> exponentials;  ///< on as many cores
  std::vector<Entry> axes;
  std::vector<Entry> lists;  ///< of the same servos
};

Entries enter_all() {
  Entries entries;
  const std::string widest = std::string(", ") + name_of(widest_vector_unit());
  for (const VectorUnit unit : available_vector_units()) {
    entries.lanes.push_back(enter(std::string("1 core, 3 axes, ") + name_of(unit), thesis_grid(),
                                  {.threads = 1, .unit = unit}));
  }
  for (const std::size_t cores : numbers_of_cores()) {
    entries.cores.push_back(cores == 1 ? entries.lanes.back()
                                       : enter(cores_text(cores) + ", 3 axes" + widest,
                                               thesis_grid(), {.threads = cores}));
    entries.exponentials.push_back(enter_exponentials(cores));
  }
  for (std::size_t axes = 1; axes <= 5; ++axes) {
    const std::string name = "1 core, grid of " + std::to_string(axes) + widest;
    const Grid grid = grid_of_axes(axes);
    entries.axes.push_back(enter(name, grid, {.threads = 1}));
    entries.lists.push_back(enter_list(name, servos_of(grid)));
  }
  return entries;
}

void print(const char* by, const char* unit, const std::vector<Entry>& entries,
           const FastestTimes& times) {
  std::printf("\n| by %s | %s | ns each | a second | times the first |\n|---|--:|--:|--:|--:|\n",
              by, unit);
  const auto speed = [&](const Entry& entry) {
    return static_cast<double>(entry.points) / times.of(entry.benchmark);
  };
  for (const Entry& entry : entries) {
    std::printf("| %s | %zu | %.3g | %.3g | %.3g |\n", entry.name.c_str(), entry.points,
                1e9 / speed(entry), speed(entry), speed(entry) / speed(entries.front()));
  }
}

void print_axes(const Entries& entries, const FastestTimes& times) {
  std::printf(
      "\n| by axes | points | ns each | find_limit_cycles() of the same, ns each | ratio |\n");
  std::printf("|---|--:|--:|--:|--:|\n");
  for (std::size_t i = 0; i < entries.axes.size(); ++i) {
    const Entry& axes = entries.axes[i];
    const double time = times.of(axes.benchmark);
    const double of_list = times.of(entries.lists[i].benchmark);
    const double each = 1e9 / static_cast<double>(axes.points);
    std::printf("| %s | %zu | %.3g | %.3g | %.3g |\n", axes.name.c_str(), axes.points, each * time,
                each * of_list, time / of_list);
  }
}

}  // namespace

ReportPart enter_scaling() {
  return [entries = enter_all()](const FastestTimes& times) {
    std::printf("\n**How the speed of evaluate() grows** (by the clock)\n");
    print("lanes", "points", entries.lanes, times);
    print("cores", "points", entries.cores, times);
    print("cores, sharing nothing", "evaluations", entries.exponentials, times);
    print_axes(entries, times);
  };
}

}  // namespace gearlash::benchmarks
