// Reports the progress of work that several threads share, and lets all of them stop.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <mutex>

#include "gearlash/progress.hpp"

namespace gearlash {

/// Counts the pieces that are done. Each piece may take it as its own progress, and so learns of a
/// stop while it lasts.
class SharedProgress : public Progress {
 public:
  SharedProgress(Progress& whole, std::size_t pieces)
      : whole_(whole), pieces_(static_cast<double>(pieces)) {}

  /// Of one piece, whose share is not counted.
  bool go_on(double /*share*/, std::size_t bytes = 0) override { return finish(0, bytes); }

  /// `more` pieces are done. False: stop.
  bool finish(std::size_t more, std::size_t bytes = 0) {
    const std::scoped_lock lock(telling_);
    done_ += more;
    if (!stopped_ && !whole_.go_on(static_cast<double>(done_) / pieces_, bytes)) stopped_ = true;
    return !stopped_;
  }
  bool is_stopped() const { return stopped_; }
  std::size_t done() const { return done_; }

 private:
  Progress& whole_;
  double pieces_;
  std::mutex telling_;
  std::size_t done_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// Serializes the progress of several threads. One that knows no share of its own (NaN) repeats the
/// last one.
class SerialProgress : public Progress {
 public:
  explicit SerialProgress(Progress& progress) : progress_(progress) {}

  bool go_on(double share, std::size_t bytes = 0) override {
    const std::scoped_lock lock(telling_);
    if (!std::isnan(share)) share_ = share;
    return progress_.go_on(share_, bytes);
  }

 private:
  Progress& progress_;
  std::mutex telling_;
  double share_ = 0.0;
};

}  // namespace gearlash
