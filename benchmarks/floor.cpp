#include "floor.hpp"

#include <cstdio>
#include <memory>

#include "grid_race.hpp"
#include "kernel_alone.hpp"
#include "kernel_counts.hpp"
#include "servo_lists.hpp"
#include "vector_functions.hpp"

namespace gearlash::benchmarks {
namespace {

std::string name_of_benchmark(VectorUnit unit, Operation operation) {
  return std::string("Vector unit/") + name_of(unit) + ", " + name_of(operation);
}

Operation operation_at(std::size_t index) { return static_cast<Operation>(index); }

struct Columns {
  alignas(64) double x[column_length];
  alignas(64) double y[column_length];
  alignas(64) double result[column_length];
};

void enter_operation(VectorUnit unit, Operation operation,
                     const std::shared_ptr<Columns>& columns) {
  const ColumnFunction function = column_functions(unit)[static_cast<std::size_t>(operation)];
  benchmark::RegisterBenchmark(name_of_benchmark(unit, operation).c_str(),
                               [=](benchmark::State& state) {
                                 for (auto _ : state) {
                                   function(columns->x, columns->y, columns->result);
                                   benchmark::ClobberMemory();
                                 }
                               })
      ->MinTime(0.02);
}

std::shared_ptr<Columns> arguments() {
  auto columns = std::make_shared<Columns>();
  for (std::size_t i = 0; i < column_length; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(column_length);
    columns->x[i] = share;
    columns->y[i] = 2.0 * share - 1.0;
  }
  return columns;
}

/// What the kernel does to a servo of the grid: alone, and in the lanes of each unit.
struct Counts {
  ByOperation<double> alone;
  std::vector<ByOperation<double>> in_step;  ///< by unit
};

Counts count_operations(const std::vector<VectorUnit>& units) {
  const std::vector<NormalizedServo> servos = servos_of(thesis_grid());
  Counts counts{operations_of_kernel(servos, 1), {}};
  for (const VectorUnit unit : units) {
    counts.in_step.push_back(operations_of_kernel(servos, lanes_in_step(unit)));
  }
  return counts;
}

/// Nanoseconds of an operation in one lane.
double time_of(const FastestTimes& times, VectorUnit unit, Operation operation) {
  return 1e9 * times.of(name_of_benchmark(unit, operation)) /
         static_cast<double>(column_length * operations_per_number(operation));
}

void print_counts(const std::vector<VectorUnit>& units, const Counts& counts,
                  const FastestTimes& times) {
  std::printf(
      "\n**What the kernel needs for a servo of the thesis's grid, and what it costs**\n\n");
  std::printf("| | a servo alone |");
  for (const VectorUnit unit : units) std::printf(" with %s |", name_of(unit));
  for (const VectorUnit unit : units) std::printf(" ns a lane, %s |", name_of(unit));
  std::printf("\n|---|--:|");
  for (std::size_t i = 0; i < 2 * units.size(); ++i) std::printf("--:|");
  std::printf("\n");
  for (std::size_t i = 0; i < operation_count; ++i) {
    std::printf("| %s | %.2f |", name_of(operation_at(i)), counts.alone[i]);
    for (const auto& in_step : counts.in_step) std::printf(" %.2f |", in_step[i]);
    for (const VectorUnit unit : units)
      std::printf(" %.3f |", time_of(times, unit, operation_at(i)));
    std::printf("\n");
  }
}

/// Nanoseconds of those operations for a servo.
template <class Condition>
double cost(const FastestTimes& times, VectorUnit unit, const ByOperation<double>& counts,
            const Condition& belongs) {
  double sum = 0.0;
  for (std::size_t i = 0; i < operation_count; ++i) {
    if (belongs(operation_at(i))) sum += counts[i] * time_of(times, unit, operation_at(i));
  }
  return sum;
}

/// Nanoseconds a servo.
struct Floor {
  double functions;  ///< exponential, logarithms and arc tangent
  double series;     ///< that stand for other transcendental functions
  double divisions;  ///< and roots
  double other;      ///< arithmetic
  double in_step;    ///< all of it, in the lanes
  double kernel;     ///< measured
  double small;      ///< likewise, of the same servos by find_limit_cycles(), which copies
  double batch;      ///< likewise, of more than the cache holds

  double transcendental() const { return functions + series; }
  double arithmetic() const { return transcendental() + divisions + other; }
};

Floor floor_of(const FastestTimes& times, VectorUnit unit, const ByOperation<double>& alone,
               const ByOperation<double>& in_step) {
  const auto all = [](Operation) { return true; };
  const auto of_alone = [&](const auto& belongs) { return cost(times, unit, alone, belongs); };
  Floor floor;
  floor.functions = of_alone(is_library_function);
  floor.series = of_alone(is_series);
  floor.divisions = of_alone(is_division_or_root);
  floor.other = of_alone(all) - floor.functions - floor.series - floor.divisions;
  floor.in_step = cost(times, unit, in_step, all);
  floor.kernel = 1e9 * times.of(name_of_kernel_benchmark(unit)) / servos_of_kernel_benchmark;
  floor.small = 1e9 * times.of(name_of_small_batch_benchmark(unit)) / servos_of_kernel_benchmark;
  floor.batch =
      1e9 * times.of(name_of_grid_benchmark(unit)) / static_cast<double>(thesis_grid().size());
  return floor;
}

void print_line(const char* name, const std::vector<Floor>& floors, double (*value)(const Floor&)) {
  std::printf("| %s |", name);
  for (const Floor& floor : floors) std::printf(" %.3g |", value(floor));
  std::printf("\n");
}

void print_floors(const std::vector<VectorUnit>& units, const std::vector<Floor>& floors) {
  std::printf("\n**The floor, and how far we are from it** (ns a servo)\n\n| |");
  for (const VectorUnit unit : units) std::printf(" %s |", name_of(unit));
  std::printf("\n|---|");
  for (std::size_t i = 0; i < units.size(); ++i) std::printf("--:|");
  std::printf("\n");
  using In = const Floor&;
  print_line("exp, log, log1p, atan2", floors, [](In floor) { return floor.functions; });
  print_line("series", floors, [](In floor) { return floor.series; });
  print_line("all transcendental evaluations: the floor", floors,
             [](In floor) { return floor.transcendental(); });
  print_line("divisions and square roots", floors, [](In floor) { return floor.divisions; });
  print_line("multiplications, additions, selections", floors,
             [](In floor) { return floor.other; });
  print_line("all arithmetic of a servo alone", floors,
             [](In floor) { return floor.arithmetic(); });
  print_line("the same with what neighbours in the lanes need", floors,
             [](In floor) { return floor.in_step; });
  print_line("measured: the kernel alone", floors, [](In floor) { return floor.kernel; });
  print_line("measured: find_limit_cycles() of these servos, which copies in and out", floors,
             [](In floor) { return floor.small; });
  print_line("measured: find_limit_cycles() of the whole grid, beyond the second cache", floors,
             [](In floor) { return floor.batch; });
  print_line("the kernel alone, times the floor", floors,
             [](In floor) { return floor.kernel / floor.transcendental(); });
  print_line("find_limit_cycles() of these servos, times the floor", floors,
             [](In floor) { return floor.small / floor.transcendental(); });
  print_line("find_limit_cycles() of the whole grid, times the floor", floors,
             [](In floor) { return floor.batch / floor.transcendental(); });
  print_line("the same, times exp, log, log1p, atan2 alone", floors,
             [](In floor) { return floor.batch / floor.functions; });
  print_line("the kernel alone, times all arithmetic in the lanes", floors,
             [](In floor) { return floor.kernel / floor.in_step; });
}

}  // namespace

ReportPart enter_floor() {
  const std::vector<VectorUnit> units = available_vector_units();
  const std::shared_ptr<Columns> columns = arguments();
  for (const VectorUnit unit : units) {
    for (std::size_t i = 0; i < operation_count; ++i) {
      enter_operation(unit, operation_at(i), columns);
    }
  }
  return [units, counts = count_operations(units)](const FastestTimes& times) {
    print_counts(units, counts, times);
    std::vector<Floor> floors;
    for (std::size_t i = 0; i < units.size(); ++i) {
      floors.push_back(floor_of(times, units[i], counts.alone, counts.in_step[i]));
    }
    print_floors(units, floors);
  };
}

}  // namespace gearlash::benchmarks
