#include "question/family/evaluation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/drive_box.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

/// The columns of what is computed without the motions that a drive ends in.
class FigureColumns {
 public:
  explicit FigureColumns(const CycleColumns& columns) : columns_(columns) {
    for (const QuantityInfo& info : quantities()) {
      if (!is_figure(info.quantity) || columns[info.quantity].empty()) continue;
      ask_for(info.quantity, wanted_);
      quantities_.push_back(info.quantity);
    }
  }

  bool are_none() const { return quantities_.empty(); }

  void write(std::size_t row, const Drive& drive, Progress& progress) const {
    Answer answer;
    if (const auto sound = SoundDrive::of(drive)) add_figures(*sound, wanted_, answer, progress);
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
std::size_t points_at_a_time(const EnginesNeeded& engines, bool has_figures) {
  if (has_figures) return 16;
  return engines.bounces ? 8 : 4096;
}

CycleColumns rows_of(const CycleColumns& columns, std::size_t first, std::size_t count) {
  CycleColumns rows;
  if (!columns.verdict.empty()) rows.verdict = columns.verdict.subspan(first, count);
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

/// The units of a servo's row.
struct SolvedScale {
  explicit SolvedScale(const ProportionalServo& servo)
      : natural_frequency(servo.natural_frequency),
        stiffness(servo.stiffness.value_or(not_a_number)) {}

  double natural_frequency;
  double stiffness;  ///< NaN where unknown
};

/// What a number of such a unit is multiplied by, from the normal form to SI; nullptr: nothing.
double (*factor_of(std::string_view unit))(const SolvedScale& scale) {
  if (unit == "s") return [](const SolvedScale& scale) { return 1.0 / scale.natural_frequency; };
  if (unit == "Hz" || unit == "rad/s") {
    return [](const SolvedScale& scale) { return scale.natural_frequency; };
  }
  if (unit == "J" || unit == "N m") return [](const SolvedScale& scale) { return scale.stiffness; };
  return nullptr;
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

/// What the columns say of one drive's motion. `answer`: one that is reused.
void read_back(const CycleColumns& columns, std::size_t row, Answer& answer) {
  answer.verdict = columns.verdict[row];
  answer.growth_at_rest = known(columns[Quantity::growth_at_rest][row]);
  answer.cycles.clear();
  answer.irregular.clear();
  answer.rest.reset();
  if (is_at_rest(answer.verdict) || answer.verdict == Verdict::hunts_if_disturbed) {
    answer.rest.emplace();  // at the reference
  }
  const double amplitude = columns[Quantity::amplitude][row];
  const double period = columns[Quantity::period][row];
  if (!std::isfinite(amplitude) || answer.verdict == Verdict::cannot_hunt) return;
  if (std::isnan(period)) {
    answer.irregular.push_back({.amplitude = amplitude, .error = amplitude});
  } else {
    answer.cycles.push_back({.amplitude = amplitude, .error = amplitude, .period = period});
  }
}

/// Columns of a part's own, of what read_back() needs and is not asked for.
struct OwnColumns {
  /// The columns asked for, with what is missing.
  CycleColumns completed(CycleColumns columns, std::size_t rows) {
    if (columns.verdict.empty()) {
      verdict.resize(rows);
      columns.verdict = verdict;
    }
    constexpr std::array read = {Quantity::growth_at_rest, Quantity::amplitude, Quantity::period};
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (!columns[read[i]].empty()) continue;
      numbers[i].resize(rows);
      columns[read[i]] = numbers[i];
    }
    return columns;
  }

  std::vector<Verdict> verdict;
  std::array<std::vector<double>, 3> numbers;
};

/// Consecutive rows: those in closed form are solved as a batch, the others searched.
class FamilyPart {
 public:
  FamilyPart(const Family& family, const AskedOfRows& asked, std::size_t first, std::size_t count,
             std::size_t longest_run)
      : family_(family),
        asked_(asked),
        first_(first),
        columns_(rows_of(asked.columns, first, count)),
        member_(family),
        servos_(count),
        means_(count, Means::solution),
        values_(count * family.width()),
        longest_run_(longest_run) {
    const bool needs_more = asked.take || columns_.verdict.empty();
    if (needs_more) columns_ = own_.completed(columns_, count);
  }

  RowCount work_out(const FamilyRows& rows, VectorUnit unit, SharedProgress& progress) {
    rows.fill(first_, values_);
    for (std::size_t row = 0; row < servos_.size(); ++row) place(row);
    RowCount count;
    count.solved = find_limit_cycles(servos_, columns_, unit);
    count.refused = static_cast<std::size_t>(std::count(means_.begin(), means_.end(), Means::none));
    count.solved.one_by_one -= count.refused + searched_.size();  // less the stand-ins
    if (asked_.proved) {
      count.unproved = keep_proved(servos_, columns_, [&](std::size_t row) { return box(row); });
    }
    bring_to_si();
    for (std::size_t row = 0; row < servos_.size(); ++row) {
      // What is not reached by a search is unknown.
      if (means_[row] != Means::solution) write(columns_, row, Answer{});
      complete(columns_, row);
    }
    if (asked_.take) give_closed(progress);
    search(progress);
    count.stopped = !add_figures_to_columns(progress);
    count.searched = found_;
    return count;
  }

  std::size_t to_search() const { return searched_.size(); }

 private:
  /// How a row is answered; by none if it is no valid drive.
  enum class Means : unsigned char { solution, search, none };

  /// The row is not solved: another servo stands in for it.
  void leave_out(std::size_t row, Means means) {
    servos_[row] = {.damping = 1.0};
    means_[row] = means;
  }

  std::span<const double> values(std::size_t row) const {
    return std::span<const double>(values_).subspan(row * family_.width(), family_.width());
  }

  void place(std::size_t row) {
    if (asked_.one_by_one) {
      place(row, family_.drive_at(values(row)));
    } else if (family_.normal_form()) {
      place(row, family_.normal_form_at(values(row)));
    } else if (member_.exists()) {
      const std::optional<ProportionalServo> servo = member_.servo(values(row));
      servo ? place(row, *servo, member_.drive()) : leave_out(row, Means::none);
    } else {
      place(row, family_.drive_at(values(row)));
    }
  }

  void place(std::size_t row, const NormalizedServo& servo) {
    servos_[row] = servo;
    const bool two_masses = servo.inertia_ratio > 0.0 && std::isfinite(servo.inertia_ratio);
    if (two_masses || faults(servo).empty()) return;  // the axes were checked for the rest
    leave_out(row, Means::none);
  }

  void place(std::size_t row, Drive drive) {
    std::optional<SoundDrive> sound = SoundDrive::of(std::move(drive));
    if (!sound) return leave_out(row, Means::none);
    if (!asked_.one_by_one) {
      if (const std::optional<ProportionalServo> servo = settled_servo(*sound)) {
        return place(row, *servo, sound->given());
      }
    }
    leave_out(row, Means::search);
    searched_rows_.push_back(row);
    searched_.push_back(std::move(*sound));
  }

  void place(std::size_t row, const ProportionalServo& servo, const Drive& drive) {
    servos_[row] = servo.servo;
    scales_.emplace_back(row, servo);
    if (asked_.proved && !drive.servo) boxes_.emplace(row, box_of(drive, servo).servo);
  }

  /// All servos that a row stands for.
  ServoBox box(std::size_t row) const {
    const auto computed = boxes_.find(row);
    return computed != boxes_.end() ? computed->second
                                    : box_of(servos_[row], reading_of(family_.base()));
  }

  void search(SharedProgress& progress) {
    for (std::size_t first = 0; first < searched_.size(); first += longest_run_) {
      const auto take = [&](std::size_t index, const Answer& answer) {
        const std::size_t row = searched_rows_[first + index];
        write(columns_, row, answer);
        complete(columns_, row);
        if (!answer.search || answer.search->is_complete) ++found_;
        if (asked_.take) asked_.take(first_ + row, &answer);
        return progress.finish(1);
      };
      const std::size_t count = std::min(longest_run_, searched_.size() - first);
      search_run(std::span<const SoundDrive>(searched_).subspan(first, count), asked_.wanted, take,
                 progress, asked_.scope);
      if (progress.is_stopped()) return;
    }
  }

  /// Gives the answers that need no search.
  void give_closed(SharedProgress& progress) {
    Answer answer;
    for (std::size_t row = 0; row < servos_.size(); ++row) {
      if (asked_.whole && !progress.go_on(0.0)) return;
      if (means_[row] == Means::search) continue;
      const bool is_refused = means_[row] == Means::none;
      if (asked_.whole && !is_refused) {
        answer = analyse_in_full(family_.drive_at(values(row)), asked_.wanted, progress).answer;
        answer.verdict = columns_.verdict[row];
      } else {
        read_back(columns_, row, answer);
      }
      asked_.take(first_ + row, is_refused ? nullptr : &answer);
    }
  }

  /// False if it was stopped.
  bool add_figures_to_columns(SharedProgress& progress) {
    const FigureColumns figures(columns_);
    for (std::size_t row = 0; !figures.are_none() && row < servos_.size(); ++row) {
      if (!progress.go_on(0.0)) return false;
      figures.write(row, family_.drive_at(values(row)), progress);
    }
    return true;
  }

  /// Scales all rows from the normal form to SI.
  void bring_to_si() {
    std::optional<SolvedScale> shared;
    if (family_.normal_form()) shared.emplace(*family_.normal_form());
    for (const Quantity quantity : solved_quantities) {
      const std::span<double> column = columns_[quantity];
      const auto factor = factor_of(info_of(quantity).unit);
      if (column.empty() || factor == nullptr) continue;
      for (const auto& [row, scale] : scales_) column[row] *= factor(scale);
      const double for_all = shared ? factor(*shared) : 1.0;
      if (for_all == 1.0) continue;
      for (double& number : column) number *= for_all;
    }
  }

  const Family& family_;
  const AskedOfRows& asked_;
  std::size_t first_;
  OwnColumns own_;
  CycleColumns columns_;
  FamilyMember member_;
  std::vector<NormalizedServo> servos_;
  std::vector<Means> means_;
  std::vector<double> values_;
  std::size_t longest_run_;
  std::vector<std::pair<std::size_t, SolvedScale>> scales_;
  std::map<std::size_t, ServoBox> boxes_;  ///< of servos computed from data with units
  std::vector<std::size_t> searched_rows_;
  std::vector<SoundDrive> searched_;
  std::size_t found_ = 0;  ///< answers of searched drives
};

/// Where the parts of the rows begin, and the last one's end. Searches that are followed lie on one
/// line each.
std::vector<std::size_t> parts_of(const FamilyRows& rows, bool searches, std::size_t at_a_time) {
  std::vector<std::size_t> begins;
  for (std::size_t begin = 0; begin < rows.count;) {
    begins.push_back(begin);
    const std::size_t place = (rows.into_line + begin) % rows.line;
    begin += searches ? std::min(rows.run, rows.line - place) : at_a_time;
  }
  begins.push_back(rows.count);
  return begins;
}

/// The points of a grid in order. Stepping avoids the division per axis and point of at(), which is
/// noticeable next to the kernel.
void fill_points(const Grid& grid, std::size_t first, std::span<double> values) {
  const std::size_t width = grid.axes.size();
  if (width == 0) return;
  std::vector<double> point = values_at(grid, first);
  std::vector<std::size_t> places(width);
  for (std::size_t i = width; i-- > 0;) {
    places[i] = first % grid.axes[i].values.size();
    first /= grid.axes[i].values.size();
  }
  for (std::size_t begin = 0; begin < values.size(); begin += width) {
    std::copy(point.begin(), point.end(), values.begin() + static_cast<std::ptrdiff_t>(begin));
    for (std::size_t i = width; i-- > 0;) {
      const std::vector<double>& of_axis = grid.axes[i].values;
      const bool carries = ++places[i] == of_axis.size();
      if (carries) places[i] = 0;
      point[i] = of_axis[places[i]];
      if (!carries) break;
    }
  }
}

}  // namespace

void RowCount::add(const RowCount& others) {
  solved.side_by_side += others.solved.side_by_side;
  solved.one_by_one += others.solved.one_by_one;
  searched += others.searched;
  refused += others.refused;
  unproved += others.unproved;
  stopped = stopped || others.stopped;
}

FamilyRows rows_of(const Grid& grid, std::size_t first, std::size_t count) {
  FamilyRows rows{.count = count,
                  .fill = [&grid, first](std::size_t row, std::span<double> values) {
                    fill_points(grid, first + row, values);
                  }};
  if (grid.axes.empty()) return rows;
  const Axis& last = grid.axes.back();
  const bool is_word = !parameter_of(last, grid.drive)->choices.empty();
  if (is_word) return rows;
  rows.line = last.values.size();
  rows.into_line = first % rows.line;
  return rows;
}

FamilyRows rows_of(std::span<const double> table, std::size_t width) {
  return {.count = width == 0 ? 1 : table.size() / width,
          .fill = [table, width](std::size_t first, std::span<double> values) {
            const std::span<const double> part = table.subspan(first * width, values.size());
            std::copy(part.begin(), part.end(), values.begin());
          }};
}

RowCount evaluate(const Family& family, const FamilyRows& rows, const AskedOfRows& asked,
                  Progress& progress, const Workers& workers) {
  const bool searches = asked.one_by_one || family.engines().search;
  const FigureColumns figures(asked.columns);
  const std::vector<std::size_t> begins = parts_of(
      rows, searches, points_at_a_time(family.engines(), !figures.are_none() || asked.whole));
  RowCount total;
  std::mutex adding;
  SharedProgress shared(progress, rows.count);
  const auto work = [&](std::size_t index) {
    if (shared.is_stopped()) return;
    const std::size_t count = begins[index + 1] - begins[index];
    FamilyPart part(family, asked, begins[index], count, rows.run);
    const RowCount of_part = part.work_out(rows, workers.unit, shared);
    {
      const std::scoped_lock lock(adding);
      total.add(of_part);
    }
    shared.finish(count - part.to_search());
  };
  if (begins.size() == 2) {
    work(0);
  } else {
    on_threads(workers.threads, begins.size() - 1, work);
  }
  total.stopped = total.stopped || (shared.is_stopped() && shared.done() < rows.count);
  return total;
}

RowCount evaluate(const Family& family, const Grid& grid, std::size_t first, Table& table,
                  Progress& progress, const Workers& workers) {
  return evaluate(family, rows_of(grid, first, table.rows()),
                  {.columns = columns_of(table), .proved = grid.proved}, progress, workers);
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
  return engines.search ? std::span<const Quantity>(all) : solved_quantities;
}

Table answer_at(const Family& family, std::span<const double> place, Quantity quantity,
                Progress& progress) {
  Table table(1, {&quantity, 1});
  evaluate(family, rows_of(place, place.size()), {.columns = columns_of(table)}, progress);
  return table;
}

double motion_value(const Table& table, Quantity quantity, std::size_t row) {
  const bool is_absent =
      is_at_rest(table.verdict(row)) && info_of(quantity).scope == QuantityScope::motion;
  return is_absent ? not_a_number : table[quantity][row];
}

}  // namespace gearlash
