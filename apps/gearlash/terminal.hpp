// What a person at a terminal sees and a file or a pipe does not.
#pragma once

#include <chrono>
#include <string>

namespace gearlash::cli {

/// `text` in bold where standard output is a terminal; as it is elsewhere, or with NO_COLOR set.
std::string emphasized(const std::string& text);

/// A line on standard error that tells how far long work has come. Shown only on a terminal, and
/// only when the work takes longer than a second; wiped at the end.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool is_watched_;
  bool is_shown_ = false;
  Clock::time_point next_;
};

}  // namespace gearlash::cli
