#include "base/violation.hpp"

#include <algorithm>
#include <utility>

namespace gearlash {
namespace {

/// A file of a megabyte may have a hundred thousand faults.
constexpr std::size_t most_lines = 100;

/// One line a violation; beyond `most_lines` a last one that counts the others.
std::string joined(const std::vector<Violation>& violations) {
  std::string text;
  const std::size_t count = std::min(violations.size(), most_lines);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += '\n';
    text += to_string(violations[i]);
  }
  if (count == violations.size()) return text;
  return text + "\nand " + std::to_string(violations.size() - count) + " more";
}

}  // namespace

std::string to_string(const Violation& violation) {
  std::string text;
  if (!violation.where.empty()) text += violation.where + ": ";
  text += violation.field;
  text += violation.value.empty() ? " is missing" : " = " + violation.value;
  if (!violation.permitted.empty()) text += ": " + violation.permitted;
  return text;
}

InvalidInput::InvalidInput(std::vector<Violation> violations)
    : std::invalid_argument(joined(violations)), violations_(std::move(violations)) {}

void require_none(std::vector<Violation> violations) {
  if (!violations.empty()) throw InvalidInput(std::move(violations));
}

}  // namespace gearlash
