#include "interruptible.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <stdexcept>

#include "record.hpp"

namespace gearlash::python {
namespace {

/// The calls under way, and whether the interpreter is about to end.
struct Calls {
  std::mutex mutex;
  std::condition_variable fewer;
  int count = 0;  ///< without those that wait for the end of the program
  bool must_stop = false;
  std::thread::id leaving{};  ///< the thread that ends the interpreter, which may go on
};

/// Never destroyed: threads that are left behind use it to the end.
Calls& calls() {
  static auto* const all = new Calls;
  return *all;
}

thread_local int depth = 0;  // of this thread's calls: a progress function may make others

bool may_lock() {
  const std::lock_guard held(calls().mutex);
  return !calls().must_stop || calls().leaving == std::this_thread::get_id();
}

void remove_call() {
  const std::lock_guard held(calls().mutex);
  --calls().count;
  calls().fewer.notify_all();
}

[[noreturn]] void wait_for_the_end() {
  remove_call();
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

LongCall::LongCall() {
  if (depth++ > 0) return;
  {
    const std::lock_guard held(calls().mutex);
    ++calls().count;
  }
  if (may_lock()) return;
  PyEval_SaveThread();
  wait_for_the_end();
}

LongCall::~LongCall() {
  if (--depth == 0) remove_call();
}

void stop_calls_at_exit() {
  constexpr std::chrono::seconds patience(30);
  const py::gil_scoped_release unlocked;
  std::unique_lock held(calls().mutex);
  calls().must_stop = true;
  calls().leaving = std::this_thread::get_id();
  calls().fewer.wait_for(held, patience, [] { return calls().count == 0; });
}

WithoutLock::WithoutLock() {
  if (depth == 0) throw std::logic_error("a call that is interruptible must have a LongCall");
  thread_ = PyEval_SaveThread();
}

WithoutLock::~WithoutLock() {
  if (!may_lock()) wait_for_the_end();
  PyEval_RestoreThread(thread_);
}

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
  if (!may_lock()) return false;
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
