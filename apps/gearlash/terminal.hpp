// What a person at a terminal sees and a file or a pipe does not.
#pragma once

#include <chrono>
#include <string>

#include "gearlash/progress.hpp"

namespace gearlash::cli {

/// `text` in bold where standard output is a terminal; as it is elsewhere, or with NO_COLOR set.
std::string emphasized(const std::string& text);

/// "42 %, 3.1 million servos/s, 12 s left": the share of the work done in so many seconds, how many
/// things that is a second where their number is known (0 where not), and the time left at this
/// pace. What was done before, `begun`, was not done in these seconds.
std::string progress_text(double share, double seconds, double things, const std::string& name,
                          double begun = 0.0);

/// s, of a clock that never goes back.
double steady_seconds();

/// A line on standard error that tells how far long work has come. Shown only on a terminal, and
/// only when the work takes longer than a second; wiped at the end.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(std::string what);
  /// Work on `count` things, "servos", whose rate is shown too.
  TerminalProgress(std::string what, std::size_t count, std::string name);
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  bool go_on(double share, std::size_t bytes = 0) override;
  /// The first call may come before any work: what is done then was done earlier.
  void show_done(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t count_ = 0;  ///< of things to be done; 0 where they are not counted
  std::string name_;
  double begun_ = 0.0;  ///< share that was done earlier
  bool is_watched_;
  bool is_told_ = false;   ///< has heard of its work
  std::size_t width_ = 0;  ///< of the line that is shown
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace gearlash::cli
