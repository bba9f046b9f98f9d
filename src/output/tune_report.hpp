// The tuned values of a drive, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/output.hpp"
#include "gearlash/tune.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// "gearlash/tune/3": the best values of several parameters.
struct TuneReport {
  TuneTask task{};            ///< what was asked
  std::string target_text{};  ///< as its author wrote it, or what was taken
  TunedDrive tuned{};         ///< the answer
  Answer nominal{};           ///< of the nominal drive with the tuned values
  Answer present{};           ///< of it as it is
  /// The same task without integral action, where nothing met the target with it.
  std::optional<TunedDrive> without_integral{};
  Provenance provenance{};  ///< how it was made

  [[nodiscard]] std::optional<std::string> why_integral_action_hunts()
      const;                                      ///< whatever the gains; empty where it need not
  [[nodiscard]] std::vector<Note> notes() const;  ///< of code "range-end": a tuned value is at an
                                                  ///< end of what was sought, and may lie beyond
};

/// The tuned values, how many units they hold for, the unit that limits, and what to give up where
/// nothing was found. Ends with a newline.
std::string tune_text(const TuneReport& report);

/// The report as JSON, in SI. Ends with a newline.
std::string tune_json(const TuneReport& report);

/// The file of the tuned drive, with a remark on how it was found.
std::string tuned_toml(const TuneReport& report);

}  // namespace gearlash
