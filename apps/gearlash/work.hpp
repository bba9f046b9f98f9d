// The work of a verb: its limits, Ctrl-C, and its progress on a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "gearlash/progress.hpp"

namespace gearlash::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP are noted and do not end the program. Signals that
/// were ignored at the start stay ignored. A second signal has the effect that it had before. There
/// is one at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_made() const;
  /// Ends the program as the signal would have.
  [[noreturn]] void obey() const;
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();
struct Limits {
  double seconds = no_limit;
  double bytes = no_limit;  ///< of the whole tool
};

/// Bytes that a search may keep of a motion, of so many searches at once.
std::size_t bytes_of_motion(const Limits& limits, std::size_t searches = 1);

/// The work of a verb. While it lasts, Ctrl-C and similar signals stop it as a limit does, so that
/// what is known by then can be printed.
class LimitedWork {
 public:
  /// The time begins now.
  explicit LimitedWork(const Limits& limits = {});
  const Limits& limits() const { return limits_; }

  /// False: stop.
  bool go_on();
  bool is_stopped() const { return !why_.empty(); }
  /// Whether a signal asks for the end of the program.
  bool is_interrupted() const { return request_ && request_->is_made(); }
  /// "--time-limit", "--memory-limit" or "a signal": what stopped it.
  const std::string& why() const { return why_; }
  /// The answer is printed: a signal ends the program, now if it came before.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  Limits limits_;
  Clock::time_point deadline_;
  Clock::time_point next_look_{};  ///< at the memory
  std::optional<StopRequest> request_;
  std::string why_;
};

/// The width of standard output if it is a terminal, else COLUMNS, from 40 to 160; empty where
/// neither is known.
std::optional<std::size_t> columns_of_output();

/// The text of a report fitted() to that width; as it is where there is none.
std::string fitted_to_output(const std::string& text);

/// The same with its first line in bold where standard output is a terminal and NO_COLOR is not
/// set.
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

  /// For the call of a function that is all the work.
  Progress& as_argument() { return *this; }

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
