// Grids over the normal form, as tests write them.
#pragma once

#include "question/change/drives.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {

inline NormalizedServo servo_of(const Drive& drive) {
  return {.damping = drive.servo->damping,
          .inertia_ratio = drive.servo->inertia_ratio,
          .friction_ratio = drive.servo->friction_ratio,
          .backlash = drive.servo->backlash,
          .restitution = std::get<RigidContact>(drive.contact).restitution};
}

inline NormalizedServo servo_at(const Grid& grid, const MapPoint& place) {
  return servo_at(Family(grid), place).value();
}

/// With a column for all that the closed form knows.
inline Table table_of(std::size_t rows) { return Table(rows, solved_quantities); }

/// Some points; see evaluate() in question/family/evaluation.hpp.
inline RowCount work_out(const Grid& grid, std::size_t first, Table& table,
                         const Workers& workers = {}, Progress& progress = no_progress()) {
  return evaluate(Family(grid), grid, first, table, progress, workers);
}

inline Table worked_out(const Grid& grid, const Workers& workers = {}) {
  Table table = table_of(grid.size());
  work_out(grid, 0, table, workers);
  return table;
}

}  // namespace gearlash
