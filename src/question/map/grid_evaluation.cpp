#include "question/map/grid_evaluation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "model/reduced_drive.hpp"
#include "question/analyse.hpp"
#include "question/final_servo.hpp"
#include "question/map/followed_drives.hpp"

namespace gearlash {
namespace {

constexpr bool is_figure(QuantityScope scope) {
  return scope != QuantityScope::answer && scope != QuantityScope::motion;
}

/// The columns of what is computed without the motions that a drive ends in.
class FigureColumns {
 public:
  /// `base`: see ask_for().
  FigureColumns(const CycleColumns& columns, const Drive& base) : columns_(columns) {
    for (const QuantityInfo& info : quantities()) {
      if (!is_figure(info.scope) || columns[info.quantity].empty()) continue;
      ask_for(info.quantity, base, wanted_);
      quantities_.push_back(info.quantity);
    }
  }

  bool are_none() const { return quantities_.empty(); }

  void write(std::size_t row, const Drive& drive, Progress& progress) const {
    Answer answer;
    if (faults(drive).empty()) add_figures(drive, wanted_, answer, progress);
    for (const Quantity quantity : quantities_) {
      columns_[quantity][row] = answer.value(quantity).value_or(not_a_number);
    }
  }

 private:
  const CycleColumns& columns_;
  Wanted wanted_;
  std::vector<Quantity> quantities_;
};

/// The number of points in closed form that a thread solves at a time: some tenths of a millisecond
/// without bounces, some tens of milliseconds with them or with figures.
std::size_t points_at_a_time(const EnginesNeeded& engines, const FigureColumns& figures) {
  if (!figures.are_none()) return 16;
  return engines.bounces ? 8 : 4096;
}

CycleColumns rows_of(const CycleColumns& columns, std::size_t first, std::size_t count) {
  CycleColumns rows;
  rows.verdict = columns.verdict.subspan(first, count);
  for (std::size_t i = 0; i < quantity_count; ++i) {
    if (!columns.numbers[i].empty()) rows.numbers[i] = columns.numbers[i].subspan(first, count);
  }
  return rows;
}

void write(const CycleColumns& columns, std::size_t row, const Answer& answer) {
  columns.verdict[row] = answer.verdict;
  for (std::size_t i = 0; i < quantity_count; ++i) {
    if (columns.numbers[i].empty()) continue;
    columns.numbers[i][row] = answer.value(static_cast<Quantity>(i)).value_or(not_a_number);
  }
}

/// Scales a row from the normal form to SI.
void scale(const CycleColumns& columns, std::size_t row, double natural_frequency,
           double stiffness) {
  const auto by = [&](Quantity quantity, double factor) {
    if (!columns[quantity].empty()) columns[quantity][row] *= factor;
  };
  for (const Quantity time : {Quantity::period, Quantity::engaged_time, Quantity::separated_time}) {
    by(time, 1.0 / natural_frequency);
  }
  for (const Quantity rate : {Quantity::frequency, Quantity::impact_speed}) {
    by(rate, natural_frequency);
  }
  for (const Quantity loss :
       {Quantity::motor_friction_loss, Quantity::load_friction_loss, Quantity::impact_loss}) {
    by(loss, stiffness);
  }
}

void scale(const CycleColumns& columns, std::size_t row, const FinalServo& servo) {
  scale(columns, row, servo.closed_form.natural_frequency, servo.stiffness.value_or(not_a_number));
}

/// Fills in what Answer::value() gives for drives that come to rest, and for the verdict.
void complete(const CycleColumns& columns, std::size_t row) {
  const Verdict verdict = columns.verdict[row];
  const std::span<double> words = columns[Quantity::verdict];
  if (!words.empty()) words[row] = static_cast<double>(verdict);
  if (!is_at_rest(verdict)) return;
  for (const Quantity quantity : {Quantity::amplitude, Quantity::motor_amplitude}) {
    if (!columns[quantity].empty()) columns[quantity][row] = 0.0;
  }
}

/// The points of a grid in order. Stepping avoids the division per axis and point of at(), which is
/// noticeable next to the kernel.
class GridWalk {
 public:
  GridWalk(const Grid& grid, std::size_t first)
      : grid_(grid), places_(grid.axes.size()), values_(values_at(grid, first)) {
    for (std::size_t i = places_.size(); i-- > 0;) {
      places_[i] = first % grid.axes[i].values.size();
      first /= grid.axes[i].values.size();
    }
  }

  std::span<const double> values() const { return values_; }

  void go_on() {
    for (std::size_t i = places_.size(); i-- > 0;) {
      const std::vector<double>& values = grid_.axes[i].values;
      const bool carries = ++places_[i] == values.size();
      if (carries) places_[i] = 0;
      values_[i] = values[places_[i]];
      if (!carries) return;
    }
  }

 private:
  const Grid& grid_;
  std::vector<std::size_t> places_;  ///< of the point on the axes
  std::vector<double> values_;
};

/// The rows of a list in order.
class ListWalk {
 public:
  ListWalk(const DriveList& list, std::size_t first)
      : list_(list), row_(first), values_(list.paths.size()) {
    take_values();
  }

  std::span<const double> values() const { return values_; }

  void go_on() {
    ++row_;
    if (row_ < list_.size()) take_values();
  }

 private:
  void take_values() {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = list_.values[i][row_];
  }

  const DriveList& list_;
  std::size_t row_;
  std::vector<double> values_;
};

/// Whether the drives of a part that are searched are neighbours, which may be followed.
enum class Neighbours : bool { none, in_order };

/// Consecutive points: those in closed form are solved as a batch, the others searched.
class GridPart {
 public:
  GridPart(const GridPoints& points, const CycleColumns& columns, Neighbours neighbours)
      : points_(points),
        columns_(columns),
        servos_(columns.verdict.size()),
        longest_run_(neighbours == Neighbours::in_order ? columns.verdict.size() : 1) {}

  template <class Walk>
  GridCount work_out(Walk walk, bool proved, VectorUnit unit, SharedProgress& progress) {
    Walk walk_again = walk;
    proves_ = proved;
    for (std::size_t row = 0; row < servos_.size(); ++row, walk.go_on()) {
      points_.are_of_normal_form() ? place(row, points_.normal_form_at(walk.values()))
                                   : place(row, points_.drive_at(walk.values()));
    }
    GridCount count;
    count.solved = find_limit_cycles(servos_, columns_, unit);
    count.solved.one_by_one -= refused_.size() + searched_.size();  // less the stand-ins
    if (proved) {
      count.unproved = keep_proved(servos_, columns_, [&](std::size_t row) { return box(row); });
    }
    bring_to_si();
    search(progress);
    for (const std::size_t row : refused_) write(columns_, row, Answer{});
    for (std::size_t row = 0; row < servos_.size(); ++row) complete(columns_, row);
    const FigureColumns figures(columns_, points_.drive());
    for (std::size_t row = 0; !figures.are_none() && row < servos_.size(); ++row) {
      count.stopped = !progress.go_on(0.0);
      if (count.stopped) break;
      figures.write(row, points_.drive_at(walk_again.values()), progress);
      walk_again.go_on();
    }
    count.searched = found_;
    count.refused = refused_.size();
    return count;
  }

  std::size_t to_search() const { return searched_.size(); }

 private:
  struct Scale {
    std::size_t row;
    double natural_frequency;
    double stiffness;  ///< NaN where unknown
  };

  static NormalizedServo stand_in() { return {.damping = 1.0}; }

  void place(std::size_t row, const NormalizedServo& servo) {
    servos_[row] = servo;
    const bool two_masses = servo.inertia_ratio > 0.0 && std::isfinite(servo.inertia_ratio);
    if (two_masses || faults(servo).empty()) return;  // the axes were checked for the rest
    servos_[row] = stand_in();
    refused_.push_back(row);
  }

  void place(std::size_t row, Drive drive) {
    servos_[row] = stand_in();
    if (!faults(drive).empty()) {
      refused_.push_back(row);
    } else if (const std::optional<FinalServo> servo = final_servo(drive)) {
      servos_[row] = servo->closed_form.servo;
      scales_.push_back(
          {row, servo->closed_form.natural_frequency, servo->stiffness.value_or(not_a_number)});
      if (proves_ && !drive.servo) {
        boxes_.emplace(row, box_of(drive, *servo).servo);
      }
    } else {
      searched_rows_.push_back(row);
      searched_.push_back(std::move(drive));
    }
  }

  /// All servos that a row stands for.
  ServoBox box(std::size_t row) const {
    const auto computed = boxes_.find(row);
    return computed != boxes_.end() ? computed->second
                                    : box_of(servos_[row], reading_of(points_.drive()));
  }

  void search(SharedProgress& progress) {
    // What is not reached is unknown.
    for (const std::size_t row : searched_rows_) write(columns_, row, Answer{});
    for (std::size_t first = 0; first < searched_.size(); first += longest_run_) {
      const auto take = [&](std::size_t index, const Answer& answer) {
        write(columns_, searched_rows_[first + index], answer);
        if (!answer.search || answer.search->is_complete) ++found_;
        return progress.finish(1);
      };
      const std::size_t count = std::min(longest_run_, searched_.size() - first);
      search_run(std::span<const Drive>(searched_).subspan(first, count),
                 {.proofs = false, .borders = false}, take, progress);
      if (progress.is_stopped()) return;
    }
  }

  /// Scales all rows from the normal form to SI.
  void bring_to_si() {
    if (!points_.are_of_normal_form()) {
      for (const Scale& one : scales_) {
        scale(columns_, one.row, one.natural_frequency, one.stiffness);
      }
      return;
    }
    const FinalServo& base = *points_.base();
    const double frequency = base.closed_form.natural_frequency;
    if (frequency == 1.0 && base.stiffness == 1.0) return;
    for (std::size_t row = 0; row < servos_.size(); ++row) {
      scale(columns_, row, base);
    }
  }

  const GridPoints& points_;
  CycleColumns columns_;
  std::vector<NormalizedServo> servos_;
  std::size_t longest_run_;
  std::vector<Scale> scales_;
  bool proves_ = false;
  std::map<std::size_t, ServoBox> boxes_;  ///< of servos computed from data with units
  std::vector<std::size_t> searched_rows_;
  std::vector<Drive> searched_;
  std::vector<std::size_t> refused_;
  std::size_t found_ = 0;  ///< answers of searched drives
};

}  // namespace

void GridCount::add(const GridCount& others) {
  solved.side_by_side += others.solved.side_by_side;
  solved.one_by_one += others.solved.one_by_one;
  searched += others.searched;
  refused += others.refused;
  unproved += others.unproved;
}

CycleColumns columns_of(Table& table) {
  CycleColumns columns{.verdict = table.column_of_verdicts()};
  for (std::size_t i = 0; i < quantity_count; ++i) {
    columns.numbers[i] = table.column(static_cast<Quantity>(i));
  }
  return columns;
}

std::span<const Quantity> quantities_known(const EnginesNeeded& engines) {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> list;
    for (const QuantityInfo& info : quantities()) {
      const bool is_slow = info.scope == QuantityScope::step;
      if (info.kind == QuantityKind::number && !is_slow) list.push_back(info.quantity);
    }
    return list;
  }();
  return engines.search ? std::span<const Quantity>(all) : closed_form_quantities;
}

PointAnswer answer_at(const GridPoints& points, std::span<const double> place, Quantity quantity,
                      Progress& progress) {
  PointAnswer answer;
  CycleColumns columns{.verdict = {&answer.verdict, 1}};
  columns[quantity] = {&answer.value, 1};
  if (const std::optional<FinalServo> servo = points.servo_at(place)) {
    find_limit_cycles({&servo->closed_form.servo, 1}, columns);
    scale(columns, 0, *servo);
    complete(columns, 0);
  } else {
    const Drive drive = points.drive_at(place);
    if (!faults(drive).empty()) return answer;
    write(columns, 0, analyse(drive, {.proofs = false, .borders = false}, progress));
  }
  const FigureColumns figures(columns, points.drive());
  if (!figures.are_none()) figures.write(0, points.drive_at(place), progress);
  return answer;
}

double of_motion(Quantity quantity, Verdict verdict, double value) {
  const bool is_absent = is_at_rest(verdict) && info_of(quantity).scope == QuantityScope::motion;
  return is_absent ? not_a_number : value;
}

double of_motion(const Table& table, Quantity quantity, std::size_t row) {
  return of_motion(quantity, table.verdict(row), table[quantity][row]);
}

std::size_t box_length(const Grid& grid, std::size_t first, std::size_t most) {
  std::size_t whole = 1;  // points of the axes that the box contains entirely
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    const std::size_t values = axis->values.size();
    const std::size_t left = values - first / whole % values;
    if (left < values || whole * values > most) return std::min(left, most / whole) * whole;
    whole *= values;
  }
  return whole;
}

namespace {

/// The last axis of a grid of searches. Drives beside each other on it are followed, if it has
/// numbers.
struct SearchedLine {
  std::size_t points = 1;
  std::size_t run = 1;
};

SearchedLine searched_line(const Grid& grid) {
  if (grid.axes.empty()) return {};
  const Axis& axis = grid.axes.back();
  const bool is_word = !parameter_of(axis, grid.drive)->choices.empty();
  return {.points = axis.values.size(), .run = is_word ? 1 : longest_run};
}

/// Where the parts of the points begin, and the last one's end. Runs of searches lie on one line of
/// the grid each.
std::vector<std::size_t> parts_of(const Grid& grid, const EnginesNeeded& engines, std::size_t first,
                                  std::size_t count, std::size_t points) {
  const SearchedLine line = engines.search ? searched_line(grid) : SearchedLine{};
  std::vector<std::size_t> begins;
  for (std::size_t begin = 0; begin < count;) {
    begins.push_back(begin);
    const std::size_t place = (first + begin) % line.points;
    begin += engines.search ? std::min(line.run, line.points - place) : points;
  }
  begins.push_back(count);
  return begins;
}

}  // namespace

namespace {

/// Works out the parts on all cores: `work(first, part, progress)` for the rows of each.
template <class Work>
GridCount evaluate_parts(const GridPoints& points, const std::vector<std::size_t>& begins,
                         const CycleColumns& columns, Neighbours neighbours, Progress& progress,
                         std::size_t threads, const Work& work) {
  const std::size_t count = begins.back();
  GridCount total;
  std::mutex adding;
  SharedProgress searches(progress, count);
  on_threads(threads, begins.size() - 1, [&](std::size_t index) {
    if (searches.is_stopped()) return;
    const std::size_t begin = begins[index];
    const std::size_t rows = begins[index + 1] - begin;
    GridPart part(points, rows_of(columns, begin, rows), neighbours);
    const GridCount of_part = work(begin, part, searches);
    {
      const std::scoped_lock lock(adding);
      total.add(of_part);
      total.stopped = total.stopped || of_part.stopped;
    }
    searches.finish(rows - part.to_search());
  });
  total.stopped = total.stopped || (searches.is_stopped() && searches.done() < count);
  return total;
}

}  // namespace

GridCount evaluate(const Grid& grid, const GridPoints& points, std::size_t first, std::size_t count,
                   const CycleColumns& columns, Progress& progress, const Workers& workers) {
  const std::vector<std::size_t> begins =
      parts_of(grid, points.engines(), first, count,
               points_at_a_time(points.engines(), FigureColumns(columns, points.drive())));
  const auto work = [&](std::size_t begin, GridPart& part, SharedProgress& searches) {
    return part.work_out(GridWalk(grid, first + begin), grid.proved, workers.unit, searches);
  };
  return evaluate_parts(points, begins, columns, Neighbours::in_order, progress, workers.threads,
                        work);
}

void evaluate(const DriveList& list, const GridPoints& points, const CycleColumns& columns,
              Progress& progress) {
  std::size_t at_a_time =
      points_at_a_time(points.engines(), FigureColumns(columns, points.drive()));
  if (points.engines().search) at_a_time = 1;
  std::vector<std::size_t> begins;
  for (std::size_t begin = 0; begin < list.size(); begin += at_a_time) begins.push_back(begin);
  begins.push_back(list.size());
  const auto work = [&](std::size_t begin, GridPart& part, SharedProgress& searches) {
    return part.work_out(ListWalk(list, begin), false, widest_vector_unit(), searches);
  };
  evaluate_parts(points, begins, columns, Neighbours::none, progress, 0, work);
}

}  // namespace gearlash
