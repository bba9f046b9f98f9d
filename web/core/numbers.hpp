// Columns of numbers beside a reply's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace gearlash::web {

using Json = nlohmann::ordered_json;

inline Json json_optional(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

/// The list of convert(element).
template <class List, class Convert>
Json json_list(const List& list, const Convert& convert) {
  Json json = Json::array();
  for (const auto& element : list) json.push_back(convert(element));
  return json;
}

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
