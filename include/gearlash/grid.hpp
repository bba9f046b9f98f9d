// Answers over grids of drives: any parameters on axes, one point for each combination.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"
#include "gearlash/quantity.hpp"

namespace gearlash {

/// A parameter of the drive and the values it takes.
struct Axis {
  std::string path{};            ///< "gearbox.backlash"; aliases and inverse forms too
  std::vector<double> values{};  ///< SI, rising; of a word: its choices' numbers, in any order
  bool logarithmic = false;      ///< logarithmic spacing, here and in pictures

  bool operator==(const Axis&) const = default;
};

/// `count` values from `from` to `to`, both exact, evenly spaced in value or in logarithm. A single
/// value requires equal ends. Throws InvalidInput, naming the path, for ends that are not finite or
/// not in order, a logarithm of 0 or less, or a count below 2 (equal ends: 1) or above 1,000,000.
[[nodiscard]] Axis linear(std::string_view path, double from, double to, std::size_t count);
[[nodiscard]] Axis logarithmic(std::string_view path, double from, double to, std::size_t count);

/// A drive with varied parameters: one point for each combination of the axes' values, the last
/// axis fastest.
struct Grid {
  Drive drive{};             ///< the axes replace its values
  std::vector<Axis> axes{};  ///< their parameters are set in this order
  /// Prove the closed form's verdicts on plastic contact. A verdict that the proof leaves open
  /// becomes undecided.
  bool proved = false;

  [[nodiscard]] std::size_t size() const;
  /// The drive of a point. It may be unsound: see faults().
  [[nodiscard]] Drive at(std::size_t index) const;
};

/// Every fault of the axes (a parameter that the drive does not have or that two axes vary, values
/// that are not permitted), of more than 10⁹ points, and of the drive, if every combination of the
/// axes' ends is at fault. `fields` names the axes; default: axis 1, ….
[[nodiscard]] std::vector<Fault> faults(const Grid& grid,
                                        const std::vector<std::string>& fields = {});

/// A drive with varied parameters, one drive for each row of values: they need not be on a grid.
struct DriveList {
  Drive drive{};                                  ///< the values replace its own
  std::vector<std::string> paths{};               ///< as Axis::path, set in this order
  std::vector<std::span<const double>> values{};  ///< of each path, SI; all of one length

  [[nodiscard]] std::size_t size() const { return values.empty() ? 1 : values.front().size(); }
};

/// Every fault of the paths, of their number and lengths, and of values that are not permitted:
/// those of a path are checked at their smallest and largest, and each must be a number.
[[nodiscard]] std::vector<Fault> faults(const DriveList& list);

/// Answers in SI, one row per point and one column per quantity. Numbers are those of
/// Answer::value(), NaN where it is empty. Every row has a verdict.
class Table {
 public:
  Table() = default;
  /// All values are unknown. `line`: the number of values on the grid's last axis; 0: one line of
  /// all rows.
  Table(std::size_t rows, std::span<const Quantity> quantities, std::size_t line = 0);

  [[nodiscard]] std::size_t rows() const noexcept { return verdicts_.size(); }
  [[nodiscard]] bool has(Quantity quantity) const noexcept;
  /// All rows. Throws InvalidInput for a quantity the table was not made for.
  [[nodiscard]] std::span<const double> operator[](Quantity quantity) const;
  [[nodiscard]] std::span<const Verdict> verdicts() const noexcept { return verdicts_; }
  [[nodiscard]] Verdict verdict(std::size_t row) const { return verdicts_.at(row); }

  /// The values along the last axis, with the other axes fixed: line 0, 1, ….
  [[nodiscard]] std::span<const double> line(Quantity quantity, std::size_t number) const;
  /// The index of the smallest known number of a line; the line's length where none is known.
  [[nodiscard]] std::size_t smallest(Quantity quantity, std::size_t number) const;

  /// For writing; empty for a quantity the table was not made for.
  [[nodiscard]] std::span<double> column(Quantity quantity) noexcept;
  [[nodiscard]] std::span<Verdict> column_of_verdicts() noexcept { return verdicts_; }

 private:
  std::vector<Verdict> verdicts_{};
  std::array<std::vector<double>, quantity_count> columns_{};  ///< by Quantity
  std::size_t line_ = 0;
};

/// The answer of each drive of the grid, on all cores, with the same bits for any number of cores.
/// Drives that are physically the servo of 1960 are answered in closed form, millions per second
/// with plastic contact. Others are searched, which takes seconds each, or followed along the last
/// axis: in runs of at most 32 whose ends are searched afresh, and the middle where they differ in
/// kind, and so on. What appears and vanishes again within a run may be missed. Combinations that
/// are no valid drive, and points not reached when `progress` stopped the work, stay unknown.
/// Throws InvalidInput for a grid with faults().
[[nodiscard]] Table evaluate(const Grid& grid, std::span<const Quantity> quantities,
                             Progress& progress = no_progress());
/// The same for each drive of a list. Without neighbours, none is followed: each is searched
/// afresh. Throws InvalidInput for a list with faults().
[[nodiscard]] Table evaluate(const DriveList& list, std::span<const Quantity> quantities,
                             Progress& progress = no_progress());
[[nodiscard]] inline Table evaluate(const Grid& grid, std::initializer_list<Quantity> quantities,
                                    Progress& progress = no_progress()) {
  return evaluate(grid, std::span<const Quantity>(quantities.begin(), quantities.size()), progress);
}

}  // namespace gearlash
