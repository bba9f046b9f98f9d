// What Google Benchmark measured: of each benchmark the fastest repetition.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <string>

namespace gearlash::benchmarks {

/// Shows the runs as usual, on standard error, and keeps the fastest repetition of each.
class FastestTimes : public benchmark::ConsoleReporter {
 public:
  FastestTimes();
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Seconds of an iteration: of the processor's time in the calling thread, or, for a benchmark
  /// that measures it, of the clock's. NaN where it was not run.
  double of(const std::string& benchmark) const;

 private:
  std::map<std::string, double> fastest_;
};

/// A part of the report. What is to be measured for it is registered before; it prints its tables
/// in Markdown.
using ReportPart = std::function<void(const FastestTimes& times)>;

}  // namespace gearlash::benchmarks
