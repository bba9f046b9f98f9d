#include "kernel_alone.hpp"

#include <cstdio>
#include <memory>

#include "closed_form/lanes/cycle_kernel.hpp"
#include "fused_kernel.hpp"
#include "servo_lists.hpp"

namespace gearlash::benchmarks {
namespace {

using detail::CycleBlock;

struct Entry {
  std::string benchmark;
  std::string name;
};

/// From all over the thesis's grid, neighbours by blocks, and few enough for the second cache.
std::vector<NormalizedServo> servos_of_grid() {
  constexpr std::size_t count =
      static_cast<std::size_t>(servos_of_kernel_benchmark) / CycleBlock::rows;
  const Grid grid = thesis_grid();
  const std::size_t stride = grid.size() / count;
  const std::vector<NormalizedServo> all = servos_of(grid);
  std::vector<NormalizedServo> servos;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t row = 0; row < CycleBlock::rows; ++row) {
      servos.push_back(all[i * stride + row]);
    }
  }
  return servos;
}

std::vector<CycleBlock> blocks_of(const std::vector<NormalizedServo>& servos) {
  std::vector<CycleBlock> blocks(servos.size() / CycleBlock::rows);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t row = 0; row < CycleBlock::rows; ++row) {
      const NormalizedServo& servo = servos[i * CycleBlock::rows + row];
      blocks[i].damping[row] = servo.damping;
      blocks[i].inertia_ratio[row] = servo.inertia_ratio;
      blocks[i].friction_ratio[row] = servo.friction_ratio;
      blocks[i].backlash[row] = servo.backlash;
    }
  }
  return blocks;
}

std::string title_of(const std::string& name) { return "Kernel alone/" + name; }

using Blocks = std::shared_ptr<std::vector<CycleBlock>>;

Entry enter(const std::string& name, detail::CycleKernel kernel, const Blocks& blocks) {
  const std::string title = title_of(name);
  benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      for (CycleBlock& block : *blocks) kernel(block, CycleBlock::rows);
      benchmark::ClobberMemory();
    }
  })->Unit(benchmark::kMicrosecond);
  return {title, name};
}

/// The same servos as a list.
void enter_batch(VectorUnit unit, const std::vector<NormalizedServo>& servos) {
  const auto table = std::make_shared<Table>(table_of(servos.size()));
  benchmark::RegisterBenchmark(name_of_small_batch_benchmark(unit).c_str(),
                               [=](benchmark::State& state) {
                                 for (auto _ : state) {
                                   find_limit_cycles(servos, columns_of(*table), unit);
                                   benchmark::ClobberMemory();
                                 }
                               })
      ->Unit(benchmark::kMicrosecond);
}

detail::CycleKernel kernel_of(VectorUnit unit) {
#ifdef GEARLASH_X86_VECTOR_UNITS
  if (unit == VectorUnit::avx512) return detail::solve_block_avx512;
  if (unit == VectorUnit::avx2) return detail::solve_block_avx2;
#endif
  static_cast<void>(unit);
  return detail::solve_block_baseline;
}

}  // namespace

std::string name_of_kernel_benchmark(VectorUnit unit) { return title_of(name_of(unit)); }

std::string name_of_small_batch_benchmark(VectorUnit unit) {
  return std::string("Small batch/") + name_of(unit);
}

// Here, and not in a file that is compiled for the processor it asks about.
bool has_fused_kernel() {
#ifdef GEARLASH_X86_VECTOR_UNITS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

ReportPart enter_kernel_alone() {
  const std::vector<NormalizedServo> servos = servos_of_grid();
  const auto blocks = std::make_shared<std::vector<CycleBlock>>(blocks_of(servos));
  std::vector<Entry> entries;
  for (const VectorUnit unit : available_vector_units()) {
    enter_batch(unit, servos);
    entries.push_back(enter(name_of(unit), kernel_of(unit), blocks));
#ifdef GEARLASH_X86_VECTOR_UNITS
    if (unit == VectorUnit::avx2 && has_fused_kernel()) {
      entries.push_back(enter("avx2, fused", solve_block_fused_avx2, blocks));
    }
#endif
  }
  return [entries](const FastestTimes& times) {
    std::printf("\n**The kernel alone** (%.0f servos from all over the thesis's grid)\n\n",
                servos_of_kernel_benchmark);
    std::printf("| | ns a servo | times the first |\n|---|--:|--:|\n");
    for (const Entry& entry : entries) {
      const double time = times.of(entry.benchmark);
      std::printf("| %s | %.3g | %.3g |\n", entry.name.c_str(),
                  1e9 * time / servos_of_kernel_benchmark,
                  times.of(entries.front().benchmark) / time);
    }
  };
}

}  // namespace gearlash::benchmarks
