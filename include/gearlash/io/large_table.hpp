// Memory for tables of millions of servos.
#pragma once

#include <cstddef>

#include "gearlash/chart/cycle_table.hpp"

namespace gearlash {

/// CycleTable(rows), for whose columns the system is asked for large pages: brought in by 4 KB at a
/// time, the memory of a million rows can take nearly as long as working them out. Where there are
/// no large pages to be had, it is the same table all the same.
CycleTable large_cycle_table(std::size_t rows);

}  // namespace gearlash
