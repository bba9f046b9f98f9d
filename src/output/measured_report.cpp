#include "output/measured_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "output/columns.hpp"

namespace gearlash {
namespace {

/// The larger ratio of the two, of whatever direction.
double distance(const MotionBesideMeasured& motion) {
  return std::max(std::abs(std::log1p(motion.amplitude_share)),
                  std::abs(std::log1p(motion.frequency_share)));
}

std::string share_text(double share) { return fmt::format("{:+.3g} %", 100.0 * share); }

}  // namespace

std::vector<MotionBesideMeasured> AnswerReport::beside_measured() const {
  std::vector<MotionBesideMeasured> all;
  if (!measured) return all;
  const auto add = [&](const char* list, std::size_t index, double amplitude, double frequency) {
    if (!(amplitude > 0.0)) return;
    all.push_back({list, index, amplitude, frequency, measured->amplitude / amplitude - 1.0,
                   measured->frequency / frequency - 1.0});
  };
  for (std::size_t i = 0; i < answer.cycles.size(); ++i) {
    const Cycle& cycle = answer.cycles[i];
    if (cycle.stability == Stability::unstable) continue;
    add("cycles", i, cycle.amplitude, cycle.frequency());
  }
  for (std::size_t i = 0; i < answer.irregular.size(); ++i) {
    const IrregularMotion& motion = answer.irregular[i];
    if (!motion.mean_period || motion.is_motor_alone) continue;
    add("irregular", i, motion.amplitude, 1.0 / *motion.mean_period);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& one, const auto& other) {
    return distance(one) < distance(other);
  });
  return all;
}

std::string measured_text(const AnswerReport& report) {
  if (!report.measured) return "";
  const auto angle = [&](double value) {
    return "±" + significant(report.angle.from_radians(value), usual_digits) + " " +
           report.angle.name;
  };
  const auto hertz = [](double value) { return significant(value, usual_digits) + " Hz"; };
  const MeasuredHunting& measured = *report.measured;
  const std::vector<MotionBesideMeasured> all = report.beside_measured();
  std::string text = "\nMeasured: " + angle(measured.amplitude) + " at " +
                     hertz(measured.frequency) + ", beside what was found\n";
  if (all.empty()) return text + "  no motion of the load that does not fade\n";
  std::vector<std::vector<std::string>> rows;
  for (const MotionBesideMeasured& one : all) {
    const bool is_cycle = one.list == "cycles";
    rows.push_back(
        {fmt::format("{} {}", is_cycle ? "limit cycle" : "irregular motion", one.index + 1),
         angle(one.amplitude) + " at " + hertz(one.frequency),
         "amplitude " + share_text(one.amplitude_share) + ", frequency " +
             share_text(one.frequency_share)});
  }
  return text + table_text(rows);
}

}  // namespace gearlash
