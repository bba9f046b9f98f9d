// Failures of the machine: reported on standard error, exit status 3.
#pragma once

#include <functional>
#include <string>

#include "command.hpp"

namespace gearlash::cli {

/// Each line of `lines` on standard error, after the name of the program.
void report_lines(const std::string& lines);

/// Runs `work`. Returns false where the machine refused it output, a plotter, memory or a thread,
/// and reports it by report_lines(). Other exceptions pass.
bool is_within_means(const std::function<void()>& work);

/// Pictures and files beside the answer. A failure is reported at once. It withholds neither the
/// others nor the answer.
class Extras {
 public:
  void make(const std::function<void()>& work);
  /// `answer`, unless an extra has failed.
  ExitStatus status(ExitStatus answer) const {
    return all_made_ ? answer : ExitStatus::beyond_means;
  }

 private:
  bool all_made_ = true;
};

}  // namespace gearlash::cli
