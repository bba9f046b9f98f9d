// A drive written down: as TOML that reads back as the same drive, and as JSON by path.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// A file of the drive with all defaults taken, in SI units. Numbers read back exactly. A table of
/// a signal is named by its file.
std::string to_toml(const Drive& drive);

/// What every answer in JSON starts with: schema "gearlash/NAME/2", version, command and units.
nlohmann::ordered_json json_head(const char* name, const Provenance& provenance);
/// The same with the drive and the defaults taken.
nlohmann::ordered_json json_head(const char* name, const Drive& drive,
                                 const Provenance& provenance);

/// As `gearlash show` prints it: the normal form, or how fast the linear loop is, as remarks before
/// the TOML; in JSON the contract of docs/schemas/show.schema.json. Both end with a newline.
std::string show_text(const Drive& drive);
std::string show_json(const Drive& drive, const Provenance& provenance);

/// {"motor.inertia": 0.0002, "controller.kind": "PID", …}: every parameter that the drive has, in
/// SI; null for one that is not given and has no default.
nlohmann::ordered_json drive_json(const Drive& drive);

/// The paths of those parameters whose values are their defaults.
std::vector<std::string> defaults_taken(const Drive& drive);

}  // namespace gearlash
