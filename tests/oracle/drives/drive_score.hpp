// The library's answer about a drive against the fixed-step simulator, start by start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ending.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"

namespace gearlash::oracle {

enum class Agreement {
  right,
  right_as_it_fades,  ///< the library calls it rest; in the simulator the motion shrinks, small
  /// Both hunt, by amplitudes that agree to the share of irregular motion, or in a motion that the
  /// headline does not name.
  right_of_other_size,
  wrong,
  undecided,    ///< by the library
  near_border,  ///< wrong, but a start 1 % aside ends in the simulator as the library says
  /// The simulator disagrees with itself at half the step, or is unclear, or the motion is too slow
  /// for it.
  no_measure
};

[[nodiscard]] const char* name_of(Agreement agreement);

struct ScoredStart {
  StartOutcome start{};
  Agreement agreement = Agreement::undecided;
  Ending ending{};
  Ending ending_of_half_step{};  ///< where `ending` disagrees with the library
  double amplitude = 0.0;        ///< rad, of the load, that the library states
  double motor_amplitude = 0.0;
  double frequency = 0.0;  ///< Hz, that the library states
};

/// Other starts, which the library did not follow, beside its verdict.
struct RandomStarts {
  std::size_t followed = 0;
  std::size_t unclear = 0;      ///< to the simulator, or it disagrees with itself
  std::size_t near_border = 0;  ///< lead elsewhere 1 % nearer to the reference or further from it
  std::size_t unlisted = 0;     ///< hunt as the verdict says, by an amplitude that is not listed
  std::vector<std::string> contradictions{};  ///< of the verdict, in words
};

struct DriveScore {
  Answer answer{};
  double processor_seconds = 0.0;  ///< of the library
  std::size_t undecided = 0;       ///< of all starts of the library
  std::string refused{};           ///< why the simulator does not know it; then it follows no start
  std::vector<ScoredStart> starts{};
  RandomStarts random{};

  [[nodiscard]] std::size_t count(Agreement agreement) const;
  /// A verdict, no undecided start, and not stopped.
  [[nodiscard]] bool is_decided() const;
};

struct ScoreOptions {
  /// Compared, evenly spread over the library's own; empty: all.
  std::optional<std::size_t> starts = 6;
  double time_limit = 0.0;        ///< processor seconds of the library for a drive; 0: none
  std::size_t random_starts = 0;  ///< besides
  std::uint64_t seed = 1;         ///< of these
  double share = 0.02;            ///< permitted difference of amplitudes, or an encoder step
  double irregular_share = 0.2;   ///< likewise of irregular motion, besides twice its deviation
  /// A start is followed so many times longer than the library watched it, up to
  /// `ending.longest_time`: called rest, and hunting.
  double times_of_rest = 10.0;
  double times_of_hunting = 4.0;
  EndingOptions ending{};
};

/// A start is right if both say rest, both say running away, or both say hunting with amplitudes of
/// load and motor that agree. An answer without a search is compared from starts at rest. A random
/// start is 0.05 … 100 gaps away, at rest or moving, anywhere in the gap.
[[nodiscard]] DriveScore score_of(const Drive& drive, const ScoreOptions& options = {});

}  // namespace gearlash::oracle
