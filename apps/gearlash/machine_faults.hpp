// Failures of the machine: reported on standard error, exit status 3.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "command.hpp"

namespace gearlash::cli {

/// Each line of `lines` on standard error, after the name of the program.
void report_lines(const std::string& lines);

/// Runs `work`. Returns false where the machine refused it output, a plotter, memory or a thread,
/// and reports it by report_lines(). Other exceptions pass.
bool is_within_means(const std::function<void()>& work);

/// The answer, then pictures and files beside it. A failure is reported at once, and does not
/// withhold the others.
class Extras {
 public:
  /// On standard output.
  void print(const std::string& answer);
  void make(const std::function<void()>& work);
  /// `answer`, unless an extra has failed.
  ExitStatus status(ExitStatus answer) const { return failure_.value_or(answer); }

 private:
  std::optional<ExitStatus> failure_;
};

}  // namespace gearlash::cli
