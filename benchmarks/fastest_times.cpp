#include "fastest_times.hpp"

#include <algorithm>
#include <iostream>
#include <limits>

namespace gearlash::benchmarks {

FastestTimes::FastestTimes() : benchmark::ConsoleReporter(OO_None) { SetOutputStream(&std::cerr); }

void FastestTimes::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    const bool by_clock = !run.run_name.time_type.empty();
    const double time = by_clock ? run.real_accumulated_time : run.cpu_accumulated_time;
    const double seconds = time / static_cast<double>(run.iterations);
    const auto [entry, first] = fastest_.emplace(run.run_name.function_name, seconds);
    if (!first) entry->second = std::min(entry->second, seconds);
  }
}

double FastestTimes::of(const std::string& benchmark) const {
  const auto measured = fastest_.find(benchmark);
  return measured == fastest_.end() ? std::numeric_limits<double>::quiet_NaN() : measured->second;
}

}  // namespace gearlash::benchmarks
