// Long work of the library, called from Python: other Python threads run meanwhile, and Ctrl-C or
// a progress function stops it.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "gearlash/progress.hpp"

namespace gearlash::python {

namespace py = pybind11;

/// Guards each call of `interruptible` (py::call_guard). An ending interpreter ends every thread
/// that asks for its lock, by force, which C++ code does not survive ("exception not rethrown"). So
/// such calls are stopped at its exit, and their threads wait for the end of the program without
/// it.
class LongCall {
 public:
  LongCall();
  ~LongCall();
  LongCall(const LongCall&) = delete;
  LongCall& operator=(const LongCall&) = delete;
};

/// Stops the calls of all other threads and waits for them, for half a minute at most, for they use
/// what the program destroys at its end: for atexit.
void stop_calls_at_exit();

/// Gives up the interpreter's lock. Throws std::logic_error outside of a LongCall.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* thread_;
};

/// Looks for signals every few hundredths of a second, in the calling thread, which always takes
/// part in the work, and calls `report(share)`, if it is not None, as often. Work stops where
/// either raises, and where `report` returns False.
class PythonProgress final : public Progress {
 public:
  /// Throws TypeError for what is neither a function nor None.
  explicit PythonProgress(py::object report);

  bool go_on(double share, std::size_t bytes) override;

  /// Raises what stopped the work. With the interpreter's lock.
  void raise_if_stopped() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Whether it is time again.
  static bool is_due(Clock::time_point& last);

  py::object report_;
  bool has_report_;
  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point looked_ = Clock::now();
  Clock::time_point reported_ = looked_;
  double share_ = 0.0;  ///< reported last: parts of a work that begin anew do not lower it
  bool goes_on_ = true;
  std::exception_ptr raised_{};
};

/// work(progress), without the interpreter's lock.
template <class Work>
auto interruptible(const py::object& report, Work work) {
  PythonProgress progress(report);
  auto result = [&] {
    const WithoutLock unlocked;
    return work(progress);
  }();
  progress.raise_if_stopped();
  return result;
}

}  // namespace gearlash::python
