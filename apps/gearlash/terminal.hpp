// Output for a terminal alone: bold text and progress.
#pragma once

#include <chrono>
#include <string>

#include "gearlash/progress.hpp"
#include "limited_work.hpp"

namespace gearlash::cli {

/// `text` with its first line in bold where standard output is a terminal; as it is elsewhere, or
/// with NO_COLOR set.
std::string with_bold_headline(const std::string& text);

/// "42 %, 3.1 million servos/s, 12 s left": the share of the work done, the rate in things per
/// second (if their number is known, else `things` is 0), and the time left at this rate. `begun`
/// is the share that was done before these `seconds`.
std::string progress_text(double share, double seconds, double things, const std::string& name,
                          double begun = 0.0);

/// Seconds of a clock that never goes back.
double steady_seconds();

/// A line on standard error with the progress of long work. It is shown only on a terminal and only
/// after a second of work, and wiped at the end. It stops what the work's limits stop.
class TerminalProgress : public Progress {
 public:
  /// Work on `count` things, such as "servos", is shown with its rate.
  TerminalProgress(LimitedWork& work, std::string what, std::size_t count = 0,
                   std::string name = "");
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// A first call before any work gives what was done earlier.
  bool go_on(double share, std::size_t bytes = 0) override;

 private:
  using Clock = std::chrono::steady_clock;
  LimitedWork& work_;
  std::string what_;
  std::size_t count_ = 0;  ///< of things; 0 if they are not counted
  std::string name_;
  double begun_ = 0.0;  ///< share done earlier
  bool is_watched_;
  bool has_begun_ = false;  ///< after the first call
  std::size_t width_ = 0;   ///< of the line that is shown
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace gearlash::cli
