// Suggestions for keys that no drive has: words of other products, and keys of other sections.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearlash {

/// Words of data sheets, simulators and firmwares, separated by blanks, for a parameter of ours.
struct ForeignWords {
  std::string_view path;   ///< "motor.inertia"
  std::string_view words;  ///< "rotor_inertia motor_inertia jm": in lower case, with underscores
};
const std::vector<ForeignWords>& all_foreign_words();

/// " (did you mean motor.inertia or load.inertia?)", or "" if nothing is near. `section`, which may
/// be empty, is where the key stands and `known` what may stand there.
std::string guess_of_key(std::string_view section, std::string_view key,
                         const std::vector<std::string>& known);

/// The same for "section.key", or a key alone, among `known` paths.
std::string guess_of_path(std::string_view path, const std::vector<std::string>& known);

}  // namespace gearlash
