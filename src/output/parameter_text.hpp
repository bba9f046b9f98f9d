// Values of one parameter of a drive, and what the drive does, as they stand in tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "output/report_units.hpp"
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
  ParameterText(const Drive& drive, std::string parameter, const AngleUnit& angle);

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
  static constexpr int digits = 6;

  std::string with_unit(const std::string& number) const {
    return unit_.empty() ? number : number + " " + unit_;
  }

  const Drive& drive_;
  Axis axis_;
  std::string unit_;
  double size_ = 1.0;  ///< of the unit, in SI
};

/// "hunts: motor ±0.218 deg at 0.261 Hz": the verdict and the largest motion, of the motor where it
/// hunts within the gap; the growth at rest of what cannot hunt. A normal form has no frequencies.
std::string result_text(const Answer& answer, const AngleUnit& angle, bool is_normalized = false);

}  // namespace gearlash
