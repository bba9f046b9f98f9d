#include "base/violation.hpp"

#include <utility>

namespace gearlash {
namespace {

std::string joined(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) {
    if (!text.empty()) text += '\n';
    text += to_string(violation);
  }
  return text;
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
