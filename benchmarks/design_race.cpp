#include "design_race.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "question/change/derivatives.hpp"
#include "question/change/overall_margin.hpp"
#include "question/change/values.hpp"
#include "question/series/tolerance_study.hpp"

namespace gearlash::benchmarks {
namespace {

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// Ten million pieces, of which three numbers and the backlash vary.
constexpr SamplePlan sampling{.points = 625'000, .replicates = 16};

Drive sample_drive() {
  return normal_form(sample.damping, sample.inertia_ratio, sample.friction_ratio, sample.backlash);
}

TolerancedDrive toleranced() {
  return {.nominal = sample_drive(),
          .varied = {{"servo.damping", within_share(sample.damping, 0.1)},
                     {"servo.inertia_ratio", within_share(sample.inertia_ratio, 0.1)},
                     {"servo.friction_ratio", within_share(sample.friction_ratio, 0.5)},
                     {"servo.backlash", within_share(sample.backlash, 0.5)}}};
}

Target target_of(bool no_hunting) {
  Target target;
  if (no_hunting) return always_at_rest();
  target.require(Quantity::amplitude, {0.0, 0.1});
  return target;
}

struct Line {
  std::string title;
  const char* name;
  double things;  ///< of an iteration
};

template <class Work>
Line enter(const char* name, double things, const Work& work) {
  const std::string title = std::string("Design/") + name;
  benchmark::RegisterBenchmark(title.c_str(),
                               [work](benchmark::State& state) {
                                 for (auto _ : state) benchmark::DoNotOptimize(work());
                               })
      ->UseRealTime()
      ->MinTime(0.05);
  return {title, name, things};
}

}  // namespace

ReportPart enter_design_race() {
  const Drive drive = sample_drive();
  const TolerancedDrive pieces = toleranced();
  const auto search = [drive](std::string_view parameter, bool no_hunting) {
    return values(drive, parameter, target_of(no_hunting)).intervals.size();
  };
  std::vector<Line> lines;
  lines.push_back(enter("one limit cycle, analyse_limit_cycles()", 1.0,
                        [] { return analyse_limit_cycles(sample).cycles.size(); }));
  lines.push_back(enter("the same, proved, enclose_limit_cycles()", 1.0, [] {
    return enclose_limit_cycles(sample, Reading::decimal).cycles.size();
  }));
  lines.push_back(enter("a piece of ten million, study_tolerances(), all cores",
                        static_cast<double>(sampling.samples()),
                        [pieces] { return study_tolerances(pieces, sampling).hunting.value; }));
  lines.push_back(enter("sensitivities by nine parameters, drive_sensitivity()", 1.0,
                        [] { return *drive_sensitivity(sample_drive()).slope(0, 0); }));
  lines.push_back(enter("certified search of the gain for no hunting, values()", 1.0,
                        [search] { return search("controller.proportional", true); }));
  lines.push_back(enter("certified search of the gain for an amplitude, values()", 1.0,
                        [search] { return search("controller.proportional", false); }));
  lines.push_back(enter("margins of all parameters, margins()", 1.0,
                        [drive] { return margins(drive).overall->change->length(); }));
  return [lines](const FastestTimes& times) {
    const double yardstick = times.of(lines.front().title);
    if (std::isnan(yardstick)) return;
    std::printf(
        "\n**What must change** (the thesis's sample servo; by the clock)\n\n"
        "| | µs | a second | times the first |\n|---|--:|--:|--:|\n");
    for (const Line& line : lines) {
      const double seconds = times.of(line.title) / line.things;
      if (std::isnan(seconds)) continue;
      std::printf("| %s | %.4g | %.3g | %.3g |\n", line.name, 1e6 * seconds, 1.0 / seconds,
                  seconds / yardstick);
    }
  };
}

}  // namespace gearlash::benchmarks
