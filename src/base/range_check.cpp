#include "base/range_check.hpp"

#include <cmath>

#include "base/decimal.hpp"

namespace gearlash {
namespace {

std::string with_unit(std::string_view text, std::string_view unit) {
  std::string result(text);
  if (!unit.empty()) result.append(" ").append(unit);
  return result;
}

}  // namespace

std::string exact_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return shortest_text(value);
}

RangeCheck& RangeCheck::refuse(std::string_view field, std::string_view value,
                               std::string_view permitted) {
  faults_.push_back({prefix_ + std::string(field), std::string(value), std::string(permitted)});
  return *this;
}

RangeCheck& RangeCheck::positive(std::string_view field, double value, std::string_view unit) {
  if (std::isfinite(value) && value > 0.0) return *this;
  return refuse(field, with_unit(exact_text(value), unit), "must be positive and finite");
}

RangeCheck& RangeCheck::not_negative(std::string_view field, double value, std::string_view unit) {
  if (std::isfinite(value) && value >= 0.0) return *this;
  return refuse(field, with_unit(exact_text(value), unit), "must be zero or positive, and finite");
}

RangeCheck& RangeCheck::finite(std::string_view field, double value) {
  return std::isfinite(value) ? *this : refuse(field, exact_text(value), "must be finite");
}

RangeCheck& RangeCheck::outside(std::string_view field, double value, double low, double high) {
  return refuse(field, exact_text(value),
                "must be from " + exact_text(low) + " to " + exact_text(high));
}

RangeCheck& RangeCheck::include(std::vector<Fault> others) {
  faults_.insert(faults_.end(), others.begin(), others.end());
  return *this;
}

}  // namespace gearlash
