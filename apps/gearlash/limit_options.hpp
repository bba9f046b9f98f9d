// --time-limit and --memory-limit, of every verb whose work may take more than two seconds.
#pragma once

#include <string>

#include "command.hpp"
#include "limited_work.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

/// As typed; empty where not given.
struct LimitOptions {
  std::string time;
  std::string memory;
};

void add_limit_options(Command& command, LimitOptions& options);
Limits read_limits(const LimitOptions& options, Faults& faults);

/// Ends the work once its answer is printed. If it was stopped, reports by what, and what is
/// therefore `unknown`; the status is then 1. After a signal the program ends here.
ExitStatus end_work(LimitedWork& work, ExitStatus status, const std::string& unknown);

}  // namespace gearlash::cli
