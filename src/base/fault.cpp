#include "gearlash/fault.hpp"

#include <algorithm>
#include <utility>

namespace gearlash {
namespace {

/// A file of a megabyte may have a hundred thousand faults.
constexpr std::size_t most_lines = 100;

/// One line per fault. Beyond `most_lines` a last line counts the others.
std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  const std::size_t count = std::min(faults.size(), most_lines);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += '\n';
    text += to_string(faults[i]);
  }
  if (count == faults.size()) return text;
  return text + "\nand " + std::to_string(faults.size() - count) + " more";
}

}  // namespace

std::string to_string(const Fault& fault) {
  std::string text;
  if (!fault.where.empty()) text += fault.where + ": ";
  text += fault.path;
  text += fault.value.empty() ? " is missing" : " = " + fault.value;
  if (!fault.permitted.empty()) text += ": " + fault.permitted;
  return text;
}

InvalidInput::InvalidInput(std::vector<Fault> faults)
    : std::invalid_argument(joined(faults)), faults_(std::move(faults)) {}

void require_none(std::vector<Fault> faults) {
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

}  // namespace gearlash
