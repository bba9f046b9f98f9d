// The library's answer beside the library's own exact motions: `simulate`, from start to start.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"

namespace gearlash::oracle {

struct FollowOptions {
  double times_of_rest = 10.0;    ///< a start called rest is followed so many times longer ...
  double times_of_hunting = 4.0;  ///< ... and one that hunts
  std::size_t most_events = 1'000'000;  ///< of a motion, clock ticks included
  double share = 0.02;                  ///< permitted difference of amplitudes, or an encoder step
  double irregular_share = 0.2;  ///< likewise of irregular motion, besides twice its deviation
  /// A start that contradicts is near a border if it hunts by another motion of the list, rests at
  /// another place of the list, or one within this share of the gap from it does not contradict.
  /// One called rest that hunts by a motion of the list is if a rounding decides where it is by
  /// then.
  double border = 1e-3;
};

struct FollowedStart {
  std::string contradiction{};   ///< what it does instead, in words; empty if it agrees
  double amplitude = 0.0;        ///< rad, of the load at the end
  double motor_amplitude = 0.0;  ///< rad, of the motor
  double followed = 0.0;         ///< how many times longer than the search it was followed
  /// s, the last time at which the load was outside the answer's band about its final position; of
  /// a start called rest that was followed twice as long at least.
  std::optional<double> time_to_rest{};
  /// rad, where its load is then, from a reference that does not move.
  std::optional<double> place{};
};

[[nodiscard]] FollowedStart follow(const Drive& drive, const Answer& answer,
                                   const StartOutcome& start, const FollowOptions& options = {});

/// The share by which an amplitude that a start leads to may differ from the one that is listed.
[[nodiscard]] double permitted_share(const Answer& answer, const StartOutcome& start, double share,
                                     double irregular_share);

struct FollowedDrive;
/// The ends of the computed pieces of rest alone, as follow_all() does.
[[nodiscard]] FollowedDrive follow_pieces(const Drive& drive, const Answer& answer);

/// All that is followed of an answer.
struct FollowedDrive {
  std::size_t starts = 0;     ///< followed as long as wanted
  std::size_t cut_short = 0;  ///< not as long: too many events
  std::size_t near_border = 0;
  std::size_t times = 0;                      ///< to rest, compared; longer than 0
  std::size_t pieces = 0;                     ///< of rest, whose ends were followed
  std::vector<std::string> contradictions{};  ///< in words
};

/// Every start of the search. A transient that outlasts the search's, as chaotic ones may after a
/// rounding, is followed eight times longer, and twice as long as any start was. Times to rest
/// agree to 1 %. A start at each end of the computed pieces of rest stays there, in one place of
/// the gap at least; one beyond it, by 1 % of the piece, stays in none. These begin at rest, with
/// rigid faces and a controller that holds at once: without an integral, a derivative of the error,
/// or a pull before a computer's first output.
[[nodiscard]] FollowedDrive follow_all(const Drive& drive, const Answer& answer,
                                       const FollowOptions& options = {});

}  // namespace gearlash::oracle
