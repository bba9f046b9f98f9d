// What is wrong with an input, said so that its author can mend it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gearlash {

/// One field at fault. Every reader and every validate() reports in these terms.
struct Violation {
  std::string field;      ///< dotted name as the author wrote it, for example "motor.inertia"
  std::string value;      ///< the value found, as written; empty when the field is missing
  std::string permitted;  ///< what would have been accepted, with its unit
  std::string where;      ///< "file:line:column" when the input came from a file, else empty

  bool operator==(const Violation&) const = default;
};

/// One line: "servo.toml:3:11: motor.inertia = -1 kg m2: must be positive".
std::string to_string(const Violation& violation);

/// Thrown for bad input, never for a numerical outcome. Carries every violation found, not the
/// first alone; what() is one line a violation.
class InvalidInput : public std::invalid_argument {
 public:
  explicit InvalidInput(std::vector<Violation> violations);
  const std::vector<Violation>& violations() const { return violations_; }

 private:
  std::vector<Violation> violations_;
};

}  // namespace gearlash
