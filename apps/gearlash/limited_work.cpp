#include "limited_work.hpp"

#include <algorithm>
#include <fstream>

#include "gearlash/analyse.hpp"

namespace gearlash::cli {
namespace {

/// The most bytes of memory that the tool has taken so far. (getrusage() would count those of the
/// program that started it.) 0 where the system does not say.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  const std::string peak = "VmHWM:";
  constexpr double bytes_in_unit = 1024.0;
  for (std::string word; status >> word;) {
    double units = 0.0;
    if (word == peak && status >> units) return bytes_in_unit * units;
  }
  return 0.0;
}

}  // namespace

std::size_t bytes_of_motion(const Limits& limits, std::size_t searches) {
  constexpr double tool_bytes = 30e6;  // the tool itself
  // A third for a motion, what is made of it included.
  const double share = (limits.bytes - tool_bytes) / (3.0 * static_cast<double>(searches));
  const std::size_t usual = Wanted{}.motion_bytes;
  return share < static_cast<double>(usual) ? static_cast<std::size_t>(share) : usual;
}

LimitedWork::LimitedWork(const Limits& limits) : limits_(limits), request_(std::in_place) {
  constexpr double longest = 1e9;  // s; more would overflow the clock
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(limits.seconds, longest)));
}

bool LimitedWork::go_on() {
  if (is_stopped()) return false;
  const Clock::time_point now = Clock::now();
  if (is_interrupted()) {
    why_ = "a signal";
  } else if (now >= deadline_) {
    why_ = "--time-limit";
  } else if (limits_.bytes < infinity && now >= next_look_) {
    constexpr auto between_looks = std::chrono::milliseconds(10);  // each reads a file
    next_look_ = now + between_looks;
    if (peak_memory() > limits_.bytes) why_ = "--memory-limit";
  }
  return !is_stopped();
}

void LimitedWork::end() {
  if (is_interrupted()) request_->obey();
  request_.reset();
}

}  // namespace gearlash::cli
