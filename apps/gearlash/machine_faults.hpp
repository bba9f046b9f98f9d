// Failures of the machine: reported on standard error, exit status 3.
#pragma once

#include <functional>
#include <string>

namespace gearlash::cli {

/// Each line of `lines` on standard error, after the name of the program.
void report_lines(const std::string& lines);

/// Runs `work`. Returns false where the machine refused it output, a plotter,
/// memory or a thread, and reports it by report_lines(). Other exceptions pass.
bool is_within_means(const std::function<void()>& work);

}  // namespace gearlash::cli
