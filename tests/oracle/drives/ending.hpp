// Where a start of a drive ends, by fixed steps alone.
#pragma once

#include <string>

#include "computer.hpp"
#include "plain_drive.hpp"

namespace gearlash::oracle {

enum class EndKind {
  rest,       ///< nothing moves and nothing will: all numbers repeat from sample to sample
  fades,      ///< motion below a small share of gap and encoder step that shrinks
  hunts,      ///< bounded motion that goes on
  runs_away,  ///< a million times the drive's lengths away, or swings that grow to thousands of
              ///< gaps
  unclear     ///< still growing, shrinking or waiting for the integral as the time ended
};

[[nodiscard]] const char* name_of(EndKind kind);

/// On a ramp positions are those from the moving reference.
struct Ending {
  EndKind kind = EndKind::unclear;
  double amplitude = 0.0;          ///< rad, half the peak-to-peak of the load, of the last quarter
  double motor_amplitude = 0.0;    ///< rad, likewise
  double earlier_amplitude = 0.0;  ///< rad, of the load in the quarter before it
  double earlier_motor_amplitude = 0.0;  ///< rad
  double frequency = 0.0;                ///< Hz, mean, of the load or, if it stands, of the motor
  double load_position = 0.0;            ///< rad, at the end
  double time = 0.0;                     ///< s, simulated
};

struct EndingOptions {
  double longest_step = 20e-6;   ///< s; a step divides the time between two ticks of the computer
  double first_time = 40.0;      ///< s; doubled while the last quarters differ or hardly swing ...
  double longest_time = 640.0;   ///< s; ... up to this; both begin as the signals are settled, and
                                 ///< are 12 and 48 periods of a sine at least
  double trace_period = 0.5e-3;  ///< s, of the extremes kept; at least the sampling period
};

[[nodiscard]] Ending ending_of(const PlainDrive& drive, const ShaftReadings& start,
                               const EndingOptions& options = {});

struct Range {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double amplitude() const { return 0.5 * (high - low); }
  void include(double value);
};

/// Of a stretch of a motion. On a ramp positions are those from the moving reference.
struct Extremes {
  Range load{};            ///< rad
  Range motor{};           ///< rad
  Range error{};           ///< rad, reference less load
  bool stands = false;     ///< neither shaft moves in the last tenth, to 1e-6 of small_length()
  bool runs_away = false;  ///< as Ending; the extremes are of the time until then
  bool is_whole = true;    ///< no event was left out
  double time = 0.0;       ///< s, followed: less than `until` where nothing will move any more
};

/// Follows a start and gives the extremes from one time to another, s, to a 200th of the time
/// between. Throws std::invalid_argument unless 0 ≤ from < until.
[[nodiscard]] Extremes extremes_between(const PlainDrive& drive, const ShaftReadings& start,
                                        double from, double until,
                                        const EndingOptions& options = {});

/// rad: what |reference − load| exceeds for a share of the time between two times, s, by 50,000
/// equal steps of time.
[[nodiscard]] double error_exceeded_for(double share, const PlainDrive& drive,
                                        const ShaftReadings& start, double from, double until,
                                        const EndingOptions& options = {});

/// Whether two endings are the same: kinds alike (rest and fading are one), amplitudes to `share`
/// or a step of the encoder.
[[nodiscard]] bool agree(const Ending& one, const Ending& other, const PlainDrive& drive,
                         double share);

}  // namespace gearlash::oracle
