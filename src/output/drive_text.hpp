// Writing a drive as TOML that reads back as the same drive, and as JSON by path.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/output.hpp"
#include "gearlash/tolerance.hpp"
#include "gearlash/units.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/firmware.hpp"
#include "model/gains.hpp"

namespace gearlash {

/// A drive file in SI units with all defaults written out. Numbers read back exactly. A signal
/// table is named by its file.
std::string to_toml(const Drive& drive);
std::string to_toml(const TolerancedDrive& drive);  ///< see gearlash/output.hpp
/// The same without parameters that have the value of another one, so that they still follow it.
std::string given_toml(const TolerancedDrive& drive);

/// The output of `gearlash show`. Text is the TOML, preceded by remarks on the normal form or the
/// speed of the linear loop. JSON is that of ShownDrive. Both end with a newline.
std::string show_text(const Drive& drive);
std::string show_json(const Drive& drive, const Provenance& provenance);

/// The registers of a firmware as a controller in SI units.
struct ConvertedFirmware {
  std::string_view name{};             ///< the firmware's
  std::string_view source{};           ///< the title of its manual
  std::string_view left_out{};         ///< what it does and the model does not
  std::string_view shaft{};            ///< controller.shaft
  std::vector<ConvertedGain> gains{};  ///< of the controller
};

/// "gearlash/show/3": a drive with all its parameters.
struct ShownDrive {
  Drive drive{};                                   ///< its parameters
  std::optional<NormalFormNumbers> normal_form{};  ///< the servo of 1960 that it is
  std::optional<drive::TimeScales> linear_loop{};  ///< of a drive that has no normal form
  std::vector<PlacedGain> gains{};                 ///< of a drive with a gear ratio, at both shafts
  std::optional<ConvertedFirmware> firmware{};     ///< of a drive that has one
  std::vector<Note> notes{};                       ///< what a reader should know
  Provenance provenance{};                         ///< how it was made
};
ShownDrive shown_drive(const Drive& drive, const Provenance& provenance);

}  // namespace gearlash
