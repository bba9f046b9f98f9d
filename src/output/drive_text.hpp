// A drive written down: as TOML that reads back as the same drive, and as JSON by path.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"

namespace gearlash {

/// A file of the drive with all defaults taken, in SI units. Numbers read back exactly. A table of
/// a signal is named by its file.
std::string to_toml(const Drive& drive);

/// {"motor.inertia": 0.0002, "controller.kind": "PID", …}: every parameter that the drive has, in
/// SI; null for one that is not given and has no default.
nlohmann::ordered_json drive_json(const Drive& drive);

/// The paths of those parameters whose values are their defaults.
std::vector<std::string> defaults_taken(const Drive& drive);

}  // namespace gearlash
