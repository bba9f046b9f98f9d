#include "limit_options.hpp"

#include "machine_faults.hpp"

namespace gearlash::cli {
namespace {

/// "200 MB", in bytes.
double read_memory(const std::string& text) {
  constexpr double least = 100e6;
  const std::optional<double> bytes = bytes_of(text);
  if (!bytes || !(*bytes >= least)) {
    refuse("--memory-limit", text, "must be a size of at least 100 MB: \"200 MB\", \"1 GiB\"");
  }
  return *bytes;
}

}  // namespace

void add_limit_options(Command& command, LimitOptions& options) {
  command.add_option(
      "--time-limit TIME", options.time,
      "Stop the work after this time and print what is known by then, with exit status "
      "1: \"30 s\"");
  command.add_option("--memory-limit SIZE", options.memory,
                     "Stop the work likewise once the tool has taken this much memory, 100 MB or "
                     "more: \"200 MB\"");
}

Limits read_limits(const LimitOptions& options, Faults& faults) {
  Limits limits;
  if (!options.time.empty()) limits.seconds = read_time("--time-limit", options.time, faults);
  if (!options.memory.empty()) {
    limits.bytes = faults.collect([&] { return read_memory(options.memory); }, infinity);
  }
  return limits;
}

ExitStatus end_work(LimitedWork& work, ExitStatus status, const std::string& unknown) {
  if (work.is_stopped()) report_lines("stopped by " + work.why() + ": " + unknown);
  work.end();
  return work.is_stopped() ? ExitStatus::undecided : status;
}

}  // namespace gearlash::cli
