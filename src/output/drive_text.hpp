// Writing a drive as TOML that reads back as the same drive, and as JSON by path.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"
#include "output/report_units.hpp"

namespace gearlash {

/// A drive file in SI units with all defaults written out. Numbers read back exactly. A signal
/// table is named by its file.
std::string to_toml(const Drive& drive);
std::string to_toml(const TolerancedDrive& drive);  ///< see gearlash/output.hpp
/// The same without parameters that have the value of another one, so that they still follow it.
std::string given_toml(const TolerancedDrive& drive);

/// The start of every JSON answer: schema "gearlash/NAME/2", version, command and units.
nlohmann::ordered_json json_head(const char* name, const Provenance& provenance);
/// The same with the drive and the names of the defaults taken.
nlohmann::ordered_json json_head(const char* name, const Drive& drive,
                                 const Provenance& provenance);

/// The output of `gearlash show`. Text is the TOML, preceded by remarks on the normal form or the
/// speed of the linear loop. JSON follows docs/schemas/show.schema.json. Both end with a newline.
std::string show_text(const Drive& drive);
std::string show_json(const Drive& drive, const Provenance& provenance);

/// {"motor.inertia": 0.0002, "controller.kind": "PID", …}: every parameter of the drive, in SI;
/// null for one that is not given and has no default.
nlohmann::ordered_json drive_json(const Drive& drive);

/// The paths of the parameters with default values.
std::vector<std::string> defaults_taken(const Drive& drive);

}  // namespace gearlash
