#include "interruptible.hpp"

#include <algorithm>

namespace gearlash::python {

bool PythonProgress::is_due(Clock::time_point& last) {
  constexpr std::chrono::milliseconds pause(30);
  const Clock::time_point now = Clock::now();
  if (now - last < pause) return false;
  last = now;
  return true;
}

bool PythonProgress::go_on(double share, std::size_t) {
  if (!goes_on_) return false;
  const bool looks = std::this_thread::get_id() == caller_ && is_due(looked_);
  const bool reports = has_report_ && is_due(reported_);
  if (!looks && !reports) return true;
  const py::gil_scoped_acquire locked;
  try {
    if (looks && PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (reports) {
      share_ = std::max(share_, share);
      const py::object answer = report_(share_);
      goes_on_ = answer.is_none() || answer.cast<bool>();
    }
  } catch (...) {
    raised_ = std::current_exception();
    goes_on_ = false;
  }
  return goes_on_;
}

}  // namespace gearlash::python
