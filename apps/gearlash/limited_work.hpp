// The work of a verb, which limits and Ctrl-C stop.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "base/special_numbers.hpp"
#include "stop_request.hpp"

namespace gearlash::cli {

/// Infinite where there is none.
struct Limits {
  double seconds = infinity;
  double bytes = infinity;  ///< of the whole tool
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

}  // namespace gearlash::cli
