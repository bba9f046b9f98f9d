// The question: does this drive hunt, and where do its motions end?
#pragma once

#include <cstddef>
#include <optional>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

struct Wanted {
  /// Proofs by interval arithmetic where the closed form answers. Without them the verdict is only
  /// computed.
  bool proofs = true;
  /// The ceiling: Answer::ceiling.
  bool ceiling = false;
  /// The linear loop: Answer::loop, bandwidth and phase margin.
  bool loop = false;
  /// The response to Specification::step, until the load has arrived: Answer::step. It takes some
  /// milliseconds.
  bool step = false;
  /// What lies between starts that end differently: unstable cycles, and from which step on a drive
  /// hunts (Answer::thresholds). The verdict does not need it.
  bool borders = true;
  /// Answer::without and Answer::is_quantization: from a few starts each, searches without causes.
  bool causes = false;
  /// Bytes that a search keeps of a motion at most, but for its last thousand steps. It takes some
  /// two to three times as many in all.
  std::size_t motion_bytes = 64'000'000;
};

/// All that the report of an answer tells, the same from every face.
[[nodiscard]] constexpr Wanted wanted_of_report() {
  return {.ceiling = true, .loop = true, .step = true, .causes = true};
}

/// Uses the closed form if the drive is the servo of 1960 by its physics. Otherwise it simulates
/// from several starts and closes cycles by shooting. Only the final value, ramp or sine of a
/// reference or load torque matters. A search that was stopped reports it. Throws InvalidInput for
/// a faulty drive.
[[nodiscard]] Answer analyse(const Drive& drive, const Wanted& wanted = {},
                             Progress& progress = no_progress());

}  // namespace gearlash
