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

/// What is varied: a parameter of the drive over its values.
struct Axis {
  std::string path{};            ///< "gearbox.backlash"; aliases and inverse forms too
  std::vector<double> values{};  ///< SI, rising; of a word the numbers of its choices, in any order
  bool logarithmic = false;      ///< spaced, and to be drawn, so

  bool operator==(const Axis&) const = default;
};

/// `count` values from `from` to `to`, both exactly, evenly in value or in logarithm. One value
/// only where both are the same. Throws InvalidInput, naming the path, for ends that are not finite
/// or not in order, a logarithm of 0 or less, or a count below 2 (1) or above 1,000,000.
[[nodiscard]] Axis linear(std::string_view path, double from, double to, std::size_t count);
[[nodiscard]] Axis logarithmic(std::string_view path, double from, double to, std::size_t count);

/// A drive of which some parameters are varied: one point for each combination of the axes' values,
/// the last axis fastest.
struct Grid {
  Drive drive{};             ///< but for what stands on the axes
  std::vector<Axis> axes{};  ///< their parameters are set one after the other
  /// Verdicts of the closed form on plastic contact are proved; what a proof leaves open is
  /// undecided.
  bool proved = false;

  [[nodiscard]] std::size_t size() const;
  /// The drive of a point, which need not be sound: faults().
  [[nodiscard]] Drive at(std::size_t index) const;
};

/// Every fault of the axes (a parameter that the drive has not or that stands on two axes, values
/// that are not permitted), of more than 10¹⁰ points, and of the drive, if it is at fault at every
/// combination of the axes' ends. `fields` names the axes; axis 1, … where there are none.
[[nodiscard]] std::vector<Fault> faults(const Grid& grid,
                                        const std::vector<std::string>& fields = {});

/// Answers, a row a point and a column a quantity, in SI. Numbers are what Answer::value() has; NaN
/// where there is none. Verdicts are always there.
class Table {
 public:
  Table() = default;
  /// Nothing is known yet. `line`: values on the grid's last axis; 0: one line of all rows.
  Table(std::size_t rows, std::span<const Quantity> quantities, std::size_t line = 0);

  [[nodiscard]] std::size_t rows() const noexcept { return verdicts_.size(); }
  [[nodiscard]] bool has(Quantity quantity) const noexcept;
  /// All rows. Throws InvalidInput for a quantity that was not asked for.
  [[nodiscard]] std::span<const double> operator[](Quantity quantity) const;
  [[nodiscard]] std::span<const Verdict> verdicts() const noexcept { return verdicts_; }
  [[nodiscard]] Verdict verdict(std::size_t row) const { return verdicts_.at(row); }

  /// Over the last axis, the others held: line 0, 1, …
  [[nodiscard]] std::span<const double> line(Quantity quantity, std::size_t number) const;
  /// Where a line is least, of the numbers that are known; the line's length where none is.
  [[nodiscard]] std::size_t smallest(Quantity quantity, std::size_t number) const;

  /// To be written to; empty for a quantity that was not asked for.
  [[nodiscard]] std::span<double> column(Quantity quantity) noexcept;
  [[nodiscard]] std::span<Verdict> column_of_verdicts() noexcept { return verdicts_; }

 private:
  std::vector<Verdict> verdicts_{};
  std::array<std::vector<double>, quantity_count> columns_{};  ///< by Quantity
  std::size_t line_ = 0;
};

/// What each drive of the grid ends in, on all cores, the same bits for any number of them. Points
/// that are the servo of 1960 by their physics are answered in closed form, millions a second with
/// plastic contact; others are searched, which takes seconds each. Of a combination that is no
/// drive nothing is known, nor of what was not reached when `progress` stopped the work. Throws
/// InvalidInput for a grid with faults().
[[nodiscard]] Table evaluate(const Grid& grid, std::span<const Quantity> quantities,
                             Progress& progress = no_progress());
[[nodiscard]] inline Table evaluate(const Grid& grid, std::initializer_list<Quantity> quantities,
                                    Progress& progress = no_progress()) {
  return evaluate(grid, std::span<const Quantity>(quantities.begin(), quantities.size()), progress);
}

}  // namespace gearlash
