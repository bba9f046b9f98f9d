// What is wrong with an input, said so that its author can mend it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gearlash {

/// One field at fault. Every reader and every validate() reports in these terms.
struct Fault {
  std::string path;       ///< dotted name as the author wrote it, for example "motor.inertia"
  std::string value;      ///< the value found, as written; empty when the field is missing
  std::string permitted;  ///< what would have been accepted, with its unit
  std::string where;      ///< "file:line:column" when the input came from a file, else empty

  bool operator==(const Fault&) const = default;
};

/// One line: "servo.toml:3:11: motor.inertia = -1 kg m2: must be positive".
std::string to_string(const Fault& fault);

/// Thrown for bad input, never for a numerical outcome. Carries every fault found, not the
/// first alone; what() is one line a fault.
class InvalidInput : public std::invalid_argument {
 public:
  explicit InvalidInput(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace gearlash
