// The keys of a section whose `kind` decides which it has.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gearlash/drive.hpp"
#include "model/parameters.hpp"

namespace gearlash {

/// The drive as it is with each kind that the section may have, and the word of the kind. Empty for
/// a section without kinds.
std::vector<std::pair<Drive, std::string_view>> drives_of_kinds(const Drive& drive,
                                                                const std::string& section);

/// Whether the parameter is there whatever kind the section has.
bool is_of_every_kind(const Parameter& parameter, const Drive& drive, const std::string& section);

/// "is not a key of [controller] with kind = "P", but with "PD" or "PID""; "must stand beside
/// controller.kind = "cascade"" of a key that another section's kind decides. Empty if no kind has
/// the key.
std::string why_of_other_kind(const Drive& drive, const std::string& section,
                              const std::string& key);

}  // namespace gearlash
