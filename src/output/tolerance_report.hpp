// The behaviour of a production run, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/output.hpp"
#include "gearlash/tolerance.hpp"
#include "gearlash/units.hpp"
#include "question/series/worst_corner.hpp"

namespace gearlash {

/// Of a parameter that varies.
struct Moments {
  std::string path{};               ///< the parameter's
  double mean = 0.0;                ///< of its distribution
  double standard_deviation = 0.0;  ///< of its distribution
};

/// "gearlash/tolerance/3": the behaviour of a production run.
struct ToleranceReport {
  TolerancedDrive drive{};                   ///< with its tolerances
  std::string target_text{};                 ///< as its author wrote it; empty without a target
  double demanded_yield = 0.0;               ///< share; 0 without a demand
  Quantity amplitude = Quantity::amplitude;  ///< whose amplitude: of the load, or motor_amplitude
  ToleranceStudy study{};                    ///< the shares that hunt and that meet the target
  SensitivityStudy sensitivities{};  ///< without numbers where a limit stopped the work before
  EnclosedCeiling proved{};          ///< of the amplitude of all samples
  WorstCorner worst{};               ///< likewise
  std::optional<WidestBacklash> backlash{};  ///< if a yield was demanded and can be reached
  bool stopped = false;                      ///< by a limit: not all is known
  Provenance provenance{};                   ///< how it was made

  [[nodiscard]] std::vector<Moments> moments() const;  ///< of each parameter that varies
};

/// Probabilities with their error bars, quantiles, the deciding parameters, and the worst sample.
/// Ends with a newline.
std::string tolerance_text(const ToleranceReport& report);

/// The report as JSON, in SI. Numbers read back exactly. Ends with a newline.
std::string tolerance_json(const ToleranceReport& report);

}  // namespace gearlash
