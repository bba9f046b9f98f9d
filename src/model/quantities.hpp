// Reads each quantity from an answer, and gives its dimension.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/quantity.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// One entry of the list of quantities.
struct QuantityEntry {
  QuantityInfo info{};
  /// The dimension of its unit; nullptr for a bare number or a choice.
  const Dimension* dimension = nullptr;
  /// Its value; empty if it does not exist or is not known. A choice gives its number.
  std::optional<double> (*value)(const Answer& answer) = nullptr;
  std::string_view older_name{};  ///< also accepted
};

/// Of the starts of a search, those with the smallest displacement of both shafts, on every side
/// and face: Quantity::error is that of their ends.
std::vector<std::size_t> smallest_starts(const SearchRecord& search);

const QuantityEntry& entry_of(Quantity quantity) noexcept;

}  // namespace gearlash
