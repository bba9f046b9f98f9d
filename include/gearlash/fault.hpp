// What is wrong with an input, in terms that let its author correct it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gearlash {

/// One value at fault. Every reader and every faults() reports in these terms.
struct Fault {
  std::string path;       ///< dotted path as the author wrote it, for example "motor.inertia"
  std::string value;      ///< the value found, as written; empty if it is missing
  std::string permitted;  ///< what is permitted, with its unit
  std::string where{};    ///< "file:line:column" if the input came from a file, else empty

  bool operator==(const Fault&) const = default;
};

/// One line: "servo.toml:3:11: motor.inertia = -1 kg m2: must be positive".
std::string to_string(const Fault& fault);

/// Thrown for bad input, never for a numerical outcome. Carries every fault found; what() has one
/// line for each.
class InvalidInput : public std::invalid_argument {
 public:
  explicit InvalidInput(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Throws InvalidInput when there is at least one fault.
void require_none(std::vector<Fault> faults);
/// The same with the faults of several things together.
template <class... Lists>
void require_none(std::vector<Fault> faults, const std::vector<Fault>& more,
                  const Lists&... others) {
  faults.insert(faults.end(), more.begin(), more.end());
  require_none(std::move(faults), others...);
}

}  // namespace gearlash
