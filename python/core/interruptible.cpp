#include "interruptible.hpp"

#include <algorithm>

#include "record.hpp"

namespace gearlash::python {

PythonProgress::PythonProgress(py::object report)
    : report_(std::move(report)), has_report_(!report_.is_none()) {
  if (has_report_ && PyCallable_Check(report_.ptr()) == 0) {
    refuse_type("progress", "a function or None", report_);
  }
}

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
      const int truth = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
      if (truth < 0) throw py::error_already_set();
      goes_on_ = truth == 1;
    }
  } catch (...) {
    raised_ = std::current_exception();
    goes_on_ = false;
  }
  return goes_on_;
}

}  // namespace gearlash::python
