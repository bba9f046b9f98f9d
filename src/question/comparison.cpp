#include "gearlash/comparison.hpp"

#include <cmath>

#include "base/on_threads.hpp"
#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "model/firmware.hpp"
#include "model/reduced_drive.hpp"
#include "question/analyse.hpp"
#include "question/step_response.hpp"

namespace gearlash {
namespace {

void require_comparable(const std::vector<NamedDrive>& drives, const ComparisonOptions& options) {
  RangeCheck check;
  if (drives.empty() || drives.size() > most_compared_drives) {
    check.refuse("drives", std::to_string(drives.size()),
                 "must be from 1 to " + std::to_string(most_compared_drives));
  }
  if (options.step && !(std::isfinite(*options.step) && *options.step != 0.0)) {
    check.refuse("step", exact_text(*options.step), "must be an angle other than 0, rad");
  }
  if (options.until && !(std::isfinite(*options.until) && *options.until > 0.0)) {
    check.refuse("until", exact_text(*options.until), "must be positive, s");
  }
  std::vector<Fault> found = check.faults();
  for (const NamedDrive& one : drives) {
    for (Fault fault : faults(one.drive)) {
      fault.where = one.name;
      found.push_back(std::move(fault));
    }
  }
  require_none(found);
}

std::optional<double> stiffness_of(const Drive& given) {
  const Drive drive = physical_form(without_registers(given));
  const double scale = gain_scale(drive);
  using Stiffness = std::optional<double>;
  return std::visit(
      Overloaded{[&](const PID& law) -> Stiffness { return scale * law.proportional; },
                 [&](const CascadeController& law) -> Stiffness {
                   return law.position * (scale * law.speed) + scale * law.speed_integral;
                 },
                 [&](const LeadLagController& law) -> Stiffness { return scale * law.gain; },
                 [](const auto&) -> Stiffness { return std::nullopt; }},
      drive.controller.law);
}

ComparedDrive compared(const NamedDrive& one, double step, double band,
                       const ComparisonOptions& options, Progress& progress) {
  const drive::ReducedDrive reduced = reduce_settled(one.drive);
  ComparedDrive found{
      .name = one.name,
      .drive = one.drive,
      .answer = analyse(
          one.drive,
          {.ceiling = true, .loop = true, .causes = true, .motion_bytes = options.motion_bytes},
          progress),
      .encoder_step = reduced.sensing.resolution,
      .stiffness = stiffness_of(one.drive)};
  const bool is_unstable = found.answer->loop && !found.answer->loop->is_stable;
  if (!is_unstable && faults(reduced).empty()) {
    found.answer->step = options.until
                             ? drive::step_response(reduced, step, band, *options.until, progress)
                             : drive::step_response_to_end(reduced, step, band, progress);
  }
  return found;
}

}  // namespace

std::vector<ComparedDrive> compare(const std::vector<NamedDrive>& drives,
                                   const ComparisonOptions& options, Progress& progress) {
  require_comparable(drives, options);
  Drive asked = drives.front().drive;
  if (options.step) asked.specification.step = options.step;
  const double step = drive::step_of(asked);
  const double band = drive::band_of(asked, reduce(asked));
  SharedProgress shared(progress, drives.size());
  return of_each_on_threads(drives, [&](const NamedDrive& one) {
    ComparedDrive found = shared.is_stopped() ? ComparedDrive{.name = one.name, .drive = one.drive}
                                              : compared(one, step, band, options, shared);
    shared.finish(1);
    return found;
  });
}

}  // namespace gearlash
