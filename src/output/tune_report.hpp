// The tuned values of a drive, as text and as JSON.
#pragma once

#include <optional>
#include <string>

#include "gearlash/tune.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct TuneReport {
  TuneTask task{};
  std::string target_text{};  ///< as its author wrote it, or what was taken
  TunedDrive tuned{};
  Answer nominal{};  ///< of the nominal drive with the tuned values
  Answer present{};  ///< of it as it is
  /// The same task without integral action, where nothing met the target with it.
  std::optional<TunedDrive> without_integral{};
  AngleUnit angle{};  ///< of text
  Provenance provenance{};
};

/// The tuned values, how many units they hold for, the unit that limits, and what to give up where
/// nothing was found. Ends with a newline.
std::string tune_text(const TuneReport& report);

/// "gearlash/tune/2" (docs/schemas), in SI. Ends with a newline.
std::string tune_json(const TuneReport& report);

/// The file of the tuned drive, with a remark on how it was found.
std::string tuned_toml(const TuneReport& report);

/// "bandwidth", "settling", "static-error".
const char* name_of(Aim aim);

}  // namespace gearlash
