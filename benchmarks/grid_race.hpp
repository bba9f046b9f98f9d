// Many servos: find_limit_cycles() on one core with each vector unit, beside one by one, beside the
// rivals and beside the program of 1960.
#pragma once

#include <string>

#include "closed_form/lanes/cycle_batch.hpp"
#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// The benchmark of that unit on the thesis's grid, of thesis_grid().size() servos.
std::string name_of_grid_benchmark(VectorUnit unit);

ReportPart enter_grid_race();

}  // namespace gearlash::benchmarks
