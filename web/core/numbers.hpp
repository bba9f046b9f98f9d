// Columns of numbers beside a reply's JSON.
#pragma once

#include <span>
#include <vector>

#include "output/json_values.hpp"

namespace gearlash::web {

/// Collects the columns of one reply.
class Numbers {
 public:
  /// The place of the column: {"at": index, "count": n}.
  Json add(std::span<const double> column) {
    const std::size_t at = all_.size();
    all_.insert(all_.end(), column.begin(), column.end());
    return {{"at", at}, {"count", column.size()}};
  }

  std::vector<double> take() { return std::move(all_); }

 private:
  std::vector<double> all_;
};

}  // namespace gearlash::web
