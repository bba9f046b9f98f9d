#include "output/measured_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "output/columns.hpp"
#include "output/json_values.hpp"

namespace gearlash {
namespace {

/// A motion on which the drive may stay, beside the measured one.
struct Compared {
  const char* list;   ///< of the answer
  std::size_t index;  ///< in it
  double amplitude;   ///< rad
  double frequency;   ///< Hz
  double amplitude_share;
  double frequency_share;

  /// The larger ratio of the two, of whatever direction.
  double distance() const {
    return std::max(std::abs(std::log1p(amplitude_share)), std::abs(std::log1p(frequency_share)));
  }
};

std::vector<Compared> compared(const AnswerReport& report) {
  std::vector<Compared> all;
  const MeasuredHunting& measured = *report.measured;
  const auto add = [&](const char* list, std::size_t index, double amplitude, double frequency) {
    if (!(amplitude > 0.0)) return;
    all.push_back({list, index, amplitude, frequency, measured.amplitude / amplitude - 1.0,
                   measured.frequency / frequency - 1.0});
  };
  const std::vector<Cycle>& cycles = report.answer.cycles;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    if (cycles[i].stability == Stability::unstable) continue;
    add("cycles", i, cycles[i].amplitude, cycles[i].frequency());
  }
  const std::vector<IrregularMotion>& irregular = report.answer.irregular;
  for (std::size_t i = 0; i < irregular.size(); ++i) {
    const IrregularMotion& motion = irregular[i];
    if (!motion.mean_period || motion.is_motor_alone) continue;
    add("irregular", i, motion.amplitude, 1.0 / *motion.mean_period);
  }
  std::stable_sort(all.begin(), all.end(), [](const Compared& one, const Compared& other) {
    return one.distance() < other.distance();
  });
  return all;
}

std::string share_text(double share) { return fmt::format("{:+.3g} %", 100.0 * share); }

}  // namespace

std::string measured_text(const AnswerReport& report) {
  if (!report.measured) return "";
  const auto angle = [&](double value) {
    return "±" + significant(report.angle.from_radians(value), usual_digits) + " " +
           report.angle.name;
  };
  const auto hertz = [](double value) { return significant(value, usual_digits) + " Hz"; };
  const MeasuredHunting& measured = *report.measured;
  const std::vector<Compared> all = compared(report);
  std::string text = "\nMeasured: " + angle(measured.amplitude) + " at " +
                     hertz(measured.frequency) + ", beside what was found\n";
  if (all.empty()) return text + "  no motion of the load that does not fade\n";
  std::vector<std::vector<std::string>> rows;
  for (const Compared& one : all) {
    const bool is_cycle = std::string(one.list) == "cycles";
    rows.push_back(
        {fmt::format("{} {}", is_cycle ? "limit cycle" : "irregular motion", one.index + 1),
         angle(one.amplitude) + " at " + hertz(one.frequency),
         "amplitude " + share_text(one.amplitude_share) + ", frequency " +
             share_text(one.frequency_share)});
  }
  return text + table_text(rows);
}

Json measured_json(const AnswerReport& report) {
  if (!report.measured) return nullptr;
  Json motions = Json::array();
  for (const Compared& one : compared(report)) {
    motions.push_back({{"list", one.list},
                       {"index", one.index},
                       {"amplitude_share", json_number(one.amplitude_share)},
                       {"frequency_share", json_number(one.frequency_share)}});
  }
  return {{"amplitude", json_number(report.measured->amplitude)},
          {"frequency", json_number(report.measured->frequency)},
          {"motions", motions}};
}

}  // namespace gearlash
