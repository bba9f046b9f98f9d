// The kernels on servos that stand ready in their blocks: what is left of a batch without its
// copying, and what fused multiplications and additions would buy.
#pragma once

#include <string>

#include "closed_form/lanes/cycle_batch.hpp"
#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// The benchmark of that unit's kernel, and on how many servos.
std::string name_of_kernel_benchmark(VectorUnit unit);
/// That of find_limit_cycles() on the same servos.
std::string name_of_small_batch_benchmark(VectorUnit unit);
inline constexpr double servos_of_kernel_benchmark = 4096.0;

ReportPart enter_kernel_alone();

}  // namespace gearlash::benchmarks
