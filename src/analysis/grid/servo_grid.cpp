#include "analysis/grid/servo_grid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

#include "base/on_threads.hpp"
#include "base/range_check.hpp"

namespace gearlash {
namespace {

/// Points that a thread works out at a time: some tenths of a millisecond where nothing bounces,
/// some tens of milliseconds where it does.
std::size_t points_at_a_time(const ServoGrid& grid) { return grid.may_bounce() ? 8 : 4096; }

CycleColumns rows_of(const CycleColumns& columns, std::size_t first, std::size_t count) {
  const auto part = [&](auto column) { return column.subspan(first, count); };
  return {.verdict = part(columns.verdict),
          .growth_at_rest = part(columns.growth_at_rest),
          .size = part(columns.size),
          .motor_size = part(columns.motor_size),
          .period = part(columns.period),
          .multiplier = part(columns.multiplier),
          .impact_speed = part(columns.impact_speed),
          .engaged_time = part(columns.engaged_time),
          .separated_time = part(columns.separated_time),
          .motor_friction_loss = part(columns.motor_friction_loss),
          .load_friction_loss = part(columns.load_friction_loss),
          .impact_loss = part(columns.impact_loss),
          .residual = part(columns.residual)};
}

void write_nothing_known(const CycleColumns& columns, std::size_t row) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  columns.verdict[row] = Verdict::undecided;
  for (const auto& column :
       {columns.growth_at_rest, columns.size, columns.motor_size, columns.period,
        columns.multiplier, columns.impact_speed, columns.engaged_time, columns.separated_time,
        columns.motor_friction_loss, columns.load_friction_loss, columns.impact_loss,
        columns.residual}) {
    column[row] = nothing;
  }
}

/// The points of a grid one after another. at() divides once an axis and point, which is felt
/// beside the kernel.
class GridWalk {
 public:
  GridWalk(const ServoGrid& grid, std::size_t first) : grid_(grid), point_(grid.at(first)) {
    places_.resize(grid.axes.size());
    for (std::size_t i = places_.size(); i-- > 0;) {
      places_[i] = first % grid.axes[i].values.size();
      first /= grid.axes[i].values.size();
    }
  }

  const NormalizedServo& point() const { return point_; }

  void go_on() {
    for (std::size_t i = places_.size(); i-- > 0;) {
      const Axis& axis = grid_.axes[i];
      const bool carries = ++places_[i] == axis.values.size();
      if (carries) places_[i] = 0;
      point_.*field_of(axis.input) = axis.values[places_[i]];
      if (!carries) return;
    }
  }

 private:
  const ServoGrid& grid_;
  NormalizedServo point_;
  std::vector<std::size_t> places_;  ///< of the point on the axes
};

/// What is wrong with the servo at the ends of the axes, if it is so at every combination of them:
/// a combination may be none (a massless load without friction) where others are servos.
std::vector<Fault> validate_corners(const ServoGrid& grid) {
  std::vector<NormalizedServo> corners = {grid.servo};
  const NormalizedServo stand_in{.damping = 0.5};
  for (const Axis& axis : grid.axes) {
    const bool is_sound = validate(axis, "").empty();  // else that is told
    const auto field = field_of(axis.input);
    const std::size_t others = corners.size();
    for (std::size_t i = 0; i < others; ++i) {
      corners.push_back(corners[i]);
      corners[i].*field = is_sound ? axis.values.front() : stand_in.*field;
      corners.back().*field = is_sound ? axis.values.back() : stand_in.*field;
    }
  }
  std::vector<Fault> faults;
  for (const NormalizedServo& corner : corners) {
    faults = validate(corner);
    if (faults.empty()) break;
  }
  return faults;
}

GridCount evaluate_part(const ServoGrid& grid, std::size_t first, const CycleColumns& columns,
                        VectorUnit unit) {
  const NormalizedServo stand_in{.damping = 1.0};  // where a combination is no servo
  std::vector<NormalizedServo> servos(columns.verdict.size());
  std::vector<std::size_t> refused;
  GridWalk walk(grid, first);
  for (std::size_t row = 0; row < servos.size(); ++row, walk.go_on()) {
    servos[row] = walk.point();
    const double inertia_ratio = servos[row].inertia_ratio;
    const bool two_masses = inertia_ratio > 0.0 && std::isfinite(inertia_ratio);
    if (two_masses || validate(servos[row]).empty()) continue;  // all else the axes have settled
    servos[row] = stand_in;
    refused.push_back(row);
  }
  GridCount count;
  count.solved = find_limit_cycles(servos, columns, unit);
  count.solved.one_by_one -= refused.size();  // a servo without a gap is not for the lanes
  count.refused = refused.size();
  if (grid.proved) count.unproved = keep_proved(servos, columns);
  for (const std::size_t row : refused) write_nothing_known(columns, row);
  return count;
}

}  // namespace

std::size_t ServoGrid::size() const {
  std::size_t points = 1;
  for (const Axis& axis : axes) points *= axis.values.size();
  return points;
}

NormalizedServo ServoGrid::at(std::size_t index) const {
  NormalizedServo point = servo;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    point.*field_of(axis->input) = axis->values[index % axis->values.size()];
    index /= axis->values.size();
  }
  return point;
}

bool ServoGrid::may_bounce() const {
  double highest = servo.restitution;
  for (const Axis& axis : axes) {
    if (axis.input == Input::restitution && !axis.values.empty()) highest = axis.values.back();
  }
  return highest > 0.0;
}

std::vector<Fault> validate(const ServoGrid& grid, const std::vector<std::string>& fields) {
  RangeCheck check;
  double points = 1.0;
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    const Axis& axis = grid.axes[i];
    check.include(validate(axis, fields.at(i)));
    points *= static_cast<double>(axis.values.size());
    for (std::size_t j = 0; j < i; ++j) {
      if (grid.axes[j].input != axis.input) continue;
      check.refuse(fields[i], name_of(axis.input),
                   "must be another input than that of " + fields[j]);
    }
  }
  if (points > static_cast<double>(most_points_of_a_grid)) {
    check.refuse("points", exact_text(points),
                 "must be at most " + exact_text(static_cast<double>(most_points_of_a_grid)) +
                     " on all axes together");
  }
  return check.include(validate_corners(grid)).faults();
}

std::size_t box_length(const ServoGrid& grid, std::size_t first, std::size_t most) {
  std::size_t whole = 1;  // points of the axes that the box takes whole
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    const std::size_t values = axis->values.size();
    const std::size_t left = values - first / whole % values;
    if (left < values || whole * values > most) return std::min(left, most / whole) * whole;
    whole *= values;
  }
  return whole;
}

void GridCount::add(const GridCount& others) {
  solved.side_by_side += others.solved.side_by_side;
  solved.one_by_one += others.solved.one_by_one;
  refused += others.refused;
  unproved += others.unproved;
}

GridCount evaluate(const ServoGrid& grid, std::size_t first, std::size_t count,
                   const CycleColumns& cycles, const GridEvaluation& how) {
  const std::size_t part = points_at_a_time(grid);
  GridCount total;
  std::size_t done = 0;
  std::mutex telling;
  std::atomic<bool> stopped = false;
  const auto work = [&](std::size_t index) {
    if (stopped) return;
    const std::size_t begin = index * part;
    const std::size_t rows = std::min(part, count - begin);
    const GridCount of_part =
        evaluate_part(grid, first + begin, rows_of(cycles, begin, rows), how.unit);
    const std::scoped_lock lock(telling);
    total.add(of_part);
    done += rows;
    if (how.going_on && !stopped && !how.going_on(done)) stopped = true;
  };
  on_threads(how.threads, (count + part - 1) / part, work);
  total.stopped = stopped && done < count;
  return total;
}

}  // namespace gearlash
