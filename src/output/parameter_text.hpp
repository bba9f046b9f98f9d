// Values of one parameter of a drive, and what the drive does, as they stand in tables.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/design.hpp"
#include "gearlash/units.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// What a reader of numbers knows of a parameter.
struct ParameterFacts {
  std::string path{};                       ///< as its author wrote it
  std::string unit{};                       ///< SI; "1" of a bare number, empty of a word
  std::string meaning{};                    ///< one sentence, without a full stop
  std::vector<std::string_view> choices{};  ///< of a word, whose values are their indices
};
/// Precondition: the drive has the parameter.
ParameterFacts facts_of(const Drive& drive, const std::string& path);

/// Angles are in the author's unit, other numbers in SI unless show_in() says otherwise, choices
/// are words. Precondition: the drive has the parameter, and outlives this.
class ParameterText {
 public:
  ParameterText(const Drive& drive, std::string parameter, int digits = 6);

  /// Shows numbers in another unit, whose size is in SI.
  void show_in(const std::string& unit, double size);

  bool is_word() const { return !parameter_of(axis_, drive_)->choices.empty(); }

  /// Empty for NaN.
  std::string of(double value) const;
  /// Rounded up or down, so that the text is not on the other side of the value.
  std::string at_least(double value) const;
  std::string at_most(double value) const;
  /// "0.5 to 2 deg", rounded inwards.
  std::string of(const Bounds& interval) const;

 private:
  std::string with_unit(const std::string& number) const {
    return unit_.empty() ? number : number + " " + unit_;
  }

  const Drive& drive_;
  Axis axis_;
  std::string unit_;
  double size_ = 1.0;  ///< of the unit, in SI
  int digits_;
};

/// The grids of values that a search tried, of the parameters that were searched value by value.
class SearchedGrids {
 public:
  explicit SearchedGrids(const Drive& drive) : drive_(drive) {}

  /// `searched`: FeasibleValues or a ParameterMargin.
  template <class Searched>
  void add(const Searched& searched) {
    if (searched.kind != SearchKind::searched) return;
    add(searched.parameter, searched.grid.size(), searched.searched);
    located_ = std::max(located_, searched.located);
  }

  /// "gearbox.ratio, 25 values from 1 to 100; controller.kind, 2 values"; empty without one.
  const std::string& text() const { return text_; }
  /// " Ends are located to 1e-06 of their value"; empty where none is located.
  std::string located_text(const std::string& ends) const;

 private:
  void add(const std::string& parameter, std::size_t count, const Bounds& range);

  const Drive& drive_;
  std::string text_;
  double located_ = 0.0;
};

/// "motor amplitude".
std::string words_of(Quantity quantity);

/// A unit as it is shown, and its size as a table has it.
struct DrawnUnit {
  std::string name = {};  ///< empty for words and pure numbers
  double size = 1.0;      ///< in SI
};

/// Angles are in `angle`; times of a normal form without a natural frequency are in units of 1/ω_n.
DrawnUnit drawn_unit(Quantity quantity, const AngleUnit& angle, bool is_normalized);

/// "hunts: motor ±0.218 deg at 0.261 Hz": the verdict and the largest motion, of the motor where it
/// hunts within the gap; the growth at rest of what cannot hunt. A normal form has no frequencies.
std::string result_text(const Answer& answer, const Drive& drive);

/// A paragraph where one of the answers meets the target and hides_error(); empty otherwise.
std::string hidden_error_text(const Target& target, const std::vector<const Answer*>& answers,
                              const Drive& drive);

/// What a table of step responses is of: "a step of 1 deg, settled within ±0.05 deg".
std::string step_text(const StepResponse& step, const Drive& drive);

}  // namespace gearlash
