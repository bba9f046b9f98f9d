// Reference numbers of many digits, from the tables that tests/references/make writes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gearlash {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Eleven bits beyond a double: what is compared in epsilons of a double needs no more.
using Wide = long double;

/// |actual − exact|/|exact| in epsilons of a double.
inline double epsilons_off(double actual, Wide exact) {
  if (actual == exact) return 0.0;
  return static_cast<double>(std::abs((actual - exact) / exact)) / epsilon;
}

/// |actual − exact| in units of epsilon × scale.
inline double epsilons_of(double actual, Wide exact, double scale) {
  if (actual == exact) return 0.0;
  return static_cast<double>(std::abs(actual - exact)) / (epsilon * scale);
}

/// A row of numbers by the names of their columns; not a number where there is none.
class Reference {
 public:
  Reference(const std::vector<std::string>& names, const std::string& line) : names_(&names) {
    std::istringstream words(line);
    words >> kind_;
    for (std::string word; words >> word;) numbers_.push_back(std::strtold(word.c_str(), nullptr));
  }

  const std::string& kind() const { return kind_; }
  Wide operator[](std::string_view name) const {
    const auto found = std::find(names_->begin(), names_->end(), name);
    if (found == names_->end()) throw std::out_of_range(std::string(name));
    return numbers_.at(static_cast<std::size_t>(found - names_->begin()));
  }
  /// An input, which is a double as it stands.
  double input(std::string_view name) const { return static_cast<double>((*this)[name]); }

 private:
  const std::vector<std::string>* names_;
  std::string kind_;
  std::vector<Wide> numbers_;
};

/// tests/<room>/data/<table>.dat, or <room>/<table>.dat in the folder GEARLASH_REFERENCES.
class References {
 public:
  References(const std::string& room, const std::string& table) {
    const char* folder = std::getenv("GEARLASH_REFERENCES");
    const std::string sources = GEARLASH_SOURCE_DIRECTORY "/tests/" + room + "/data";
    std::ifstream file((folder ? folder + ("/" + room) : sources) + "/" + table + ".dat");
    for (std::string line; std::getline(file, line);) {
      if (line.front() == '#') continue;
      if (names_.empty()) {
        std::istringstream words(line);
        words >> line;  // the kind
        for (std::string word; words >> word;) names_.push_back(word);
      } else {
        rows_.emplace_back(names_, line);
      }
    }
    if (rows_.empty()) throw std::runtime_error("no references of " + room + "/" + table);
  }
  References(const References&) = delete;
  References& operator=(const References&) = delete;

  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }
  const Reference& front() const { return rows_.front(); }

 private:
  std::vector<std::string> names_;
  std::vector<Reference> rows_;
};

}  // namespace gearlash
