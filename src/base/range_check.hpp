// Checks of numbers against permitted ranges, collected into one list of faults.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/fault.hpp"

namespace gearlash {

/// Shortest decimal text that reads back as exactly the same double; "inf", "-inf", "nan".
std::string exact_text(double value);

/// Collects faults of one struct's fields; `prefix` precedes each field's name.
class RangeCheck {
 public:
  explicit RangeCheck(std::string_view prefix = {}) : prefix_(prefix) {}

  RangeCheck& positive(std::string_view field, double value, std::string_view unit);
  RangeCheck& not_negative(std::string_view field, double value, std::string_view unit);
  RangeCheck& finite(std::string_view field, double value);
  RangeCheck& within(std::string_view field, double value, double low, double high) {
    return value >= low && value <= high ? *this : outside(field, value, low, high);
  }
  RangeCheck& refuse(std::string_view field, std::string_view value, std::string_view permitted);

  /// Adds the faults of another check.
  RangeCheck& include(std::vector<Fault> others);

  std::vector<Fault> faults() const { return faults_; }

 private:
  RangeCheck& outside(std::string_view field, double value, double low, double high);

  std::string prefix_;
  std::vector<Fault> faults_;
};

}  // namespace gearlash
