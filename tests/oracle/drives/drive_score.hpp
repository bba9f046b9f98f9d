// The library's answer about a drive against the fixed-step simulator, start by start.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ending.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"

namespace gearlash::oracle {

enum class Agreement {
  right,
  right_as_it_fades,  ///< the library calls it rest; in the simulator the motion shrinks, small
  wrong,
  undecided,   ///< by the library
  no_measure,  ///< the simulator disagrees with itself at half the step, or is unclear
};

[[nodiscard]] const char* name_of(Agreement agreement);

struct ScoredStart {
  StartOutcome start{};
  Agreement agreement = Agreement::undecided;
  Ending ending{};
  Ending ending_of_half_step{};
  double amplitude = 0.0;  ///< rad, of the load, that the library states
  double motor_amplitude = 0.0;
  double frequency = 0.0;  ///< Hz, that the library states
};

struct DriveScore {
  Answer answer{};
  double processor_seconds = 0.0;  ///< of the library
  std::size_t undecided = 0;       ///< of all starts of the library
  std::vector<ScoredStart> starts{};

  [[nodiscard]] std::size_t count(Agreement agreement) const;
  /// A verdict, no undecided start, and not stopped.
  [[nodiscard]] bool is_decided() const;
};

struct ScoreOptions {
  std::size_t starts = 6;        ///< compared, evenly spread over the library's own; 0: all
  double time_limit = 0.0;       ///< processor seconds of the library for a drive; 0: none
  double share = 0.02;           ///< permitted difference of amplitudes, or an encoder step
  double irregular_share = 0.2;  ///< likewise of irregular motion, besides twice its deviation
  EndingOptions ending{};
};

/// A start is right if both say rest, both say running away, or both say hunting with amplitudes of
/// load and motor that agree. An answer without a search is compared from starts at rest.
[[nodiscard]] DriveScore score_of(const Drive& drive, const ScoreOptions& options = {});

}  // namespace gearlash::oracle
