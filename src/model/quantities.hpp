// How each quantity is read from an answer, and in which dimension it is written.
#pragma once

#include <optional>

#include "gearlash/answer.hpp"
#include "gearlash/quantity.hpp"
#include "model/dimension.hpp"

namespace gearlash {

/// One entry of the list of quantities.
struct QuantityEntry {
  QuantityInfo info{};
  /// In which it may be written with a unit; nullptr of a bare number or a choice.
  const Dimension* dimension = nullptr;
  /// Its value; nothing where it does not exist, or is not known. A choice gives its number.
  std::optional<double> (*value)(const Answer& answer) = nullptr;
  std::string_view older_name{};  ///< that is read, too
};

const QuantityEntry& entry_of(Quantity quantity) noexcept;

}  // namespace gearlash
