#include "map_of_searched.hpp"

#include <cstdio>
#include <string>

#include "base/on_threads.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/grid.hpp"
#include "question/pd_drive.hpp"

namespace gearlash::benchmarks {
namespace {

constexpr std::size_t values = 100;  // of each gain
constexpr std::size_t apart = 10;    // of the verdicts' gains, in values
constexpr std::size_t thinned = apart * apart;

/// A torque-controlled motor under a continuous PID controller with the sensor on the load; Coulomb
/// friction on both shafts.
Drive pid_drive() {
  Drive drive = pd_drive();
  drive.motor.inertia = 2e-6;
  drive.controller.law = PID{.terms = PIDTerms::PID,
                             .proportional = 20.0,
                             .integral = 20.0,
                             .derivative = 0.02,
                             .filter = 1e-3};
  return drive;
}

Grid grid_of_gains() {
  return {.drive = pid_drive(),
          .axes = {logarithmic("controller.proportional", 5.0, 40.0, values),
                   logarithmic("controller.derivative", 0.02, 0.08, values)}};
}

void run_map(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(grid_of_gains(), {Quantity::amplitude}));
}

/// Each drive by itself, on all cores, as the map has them.
void run_verdicts(benchmark::State& state) {
  const Grid grid = grid_of_gains();
  for (auto _ : state) {
    on_threads(0, values * values / thinned, [&](std::size_t i) {
      const std::size_t row = i / (values / apart) * apart;
      const std::size_t column = i % (values / apart) * apart;
      benchmark::DoNotOptimize(
          analyse(grid.at(row * values + column), {.proofs = false, .borders = false}));
    });
  }
}

constexpr const char* map_name = "Searched/map";
constexpr const char* verdicts_name = "Searched/verdicts";

}  // namespace

ReportPart enter_map_of_searched() {
  const auto enter = [](const char* name, void (*run)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, run)
        ->Unit(benchmark::kSecond)
        ->Iterations(1)
        ->Repetitions(1)
        ->UseRealTime();
  };
  enter(map_name, run_map);
  enter(verdicts_name, run_verdicts);
  return [](const FastestTimes& times) {
    const double map = times.of(map_name);
    const double verdicts = static_cast<double>(thinned) * times.of(verdicts_name);
    std::printf(
        "\nA map of %zu × %zu searched drives, over two gains of a continuous PID drive with "
        "friction, on all cores\n\n",
        values, values);
    std::printf("| | seconds | ratio |\n|---|--:|--:|\n");
    std::printf("| map, followed from value to value | %.3g | 1 |\n", map);
    std::printf("| as many verdicts, each by itself, from one of %zu | %.3g | %.3g |\n", thinned,
                verdicts, verdicts / map);
  };
}

}  // namespace gearlash::benchmarks
