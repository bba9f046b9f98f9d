#include "question/change/orbit_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <utility>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "general/attractors/found_cycle.hpp"
#include "hybrid/disturbances.hpp"
#include "model/sound_drive.hpp"
#include "question/axis.hpp"
#include "question/change/derivatives.hpp"
#include "question/family/analysed_line.hpp"

namespace gearlash {
namespace {

using hybrid::Event;
using hybrid::EventKind;

/// The least speed at which a guard is met, as a share of the highest.
double least_share_of_speed(const hybrid::HybridSystem& system,
                            const hybrid::PeriodicOrbit& orbit) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  double last = -1.0;
  for (const Event& event : orbit.events) {
    const bool is_chained = event.time == last;  // it has no delay of its own
    last = event.time;
    if (event.kind != EventKind::transition || is_chained) continue;
    const double speed = hybrid::speed_at_guard(system, event);
    least = std::min(least, speed);
    most = std::max(most, speed);
  }
  return most > 0.0 ? least / most : 1.0;
}

bool has_multiplier_of_one(const drive::FoundCycle& cycle) {
  const auto is_one = [](const std::complex<double>& multiplier) {
    constexpr double near = 1e-6;
    return std::abs(multiplier - 1.0) < near;
  };
  const std::vector<std::complex<double>>& all = cycle.orbit.multipliers;
  return any_of(all, is_one);
}

/// Why a cycle has no derivatives; empty if it has.
std::string obstacle_to_slopes(const drive::SearchSetting& setting,
                               const drive::FoundCycle& cycle) {
  const drive::ReducedDrive& drive = setting.drive;
  if (drive.sampling) return "the controller's ticks hold its period to multiples of their own";
  if (drive.sensing.reads_steps()) return "the encoder's steps have no derivative";
  if (is_driven(drive)) return "a sine drives it";
  const std::vector<Event>& events = cycle.orbit.events;
  if (any_of(events, [](const Event& event) { return event.kind == EventKind::settling; })) {
    return "infinitely many bounces settle in each period";
  }
  constexpr double grazing = 1e-6;
  if (least_share_of_speed(setting.system.system(), cycle.orbit) < grazing) {
    return "it grazes a border between two motions";
  }
  if (has_multiplier_of_one(cycle)) return "a multiplier is 1: it is one of a family, or at a fold";
  return "";
}

/// The largest cycle that is not unstable; nullptr if there is none.
const drive::FoundCycle* cycle_in_practice(const Analysis& analysis) {
  const Cycle* cycle = analysis.answer.largest_stable();
  if (cycle == nullptr || !analysis.search) return nullptr;
  // The answer lists the cycles of the search in its order.
  return &analysis.search->cycles[static_cast<std::size_t>(cycle - analysis.answer.cycles.data())];
}

/// The cycle of a drive beside that of the setting, by Newton's method; none where the drive is
/// unsound or the cycle has other events.
Answer answer_beside(Drive drive, const drive::SearchSetting& setting,
                     const drive::FoundCycle& cycle) {
  const std::optional<SoundDrive> sound = SoundDrive::of(std::move(drive));
  if (!sound) return {};
  const drive::SearchSetting beside = drive::search_setting(sound->settled());
  const auto orbit = neighbouring_orbit(beside.system, cycle.orbit, setting.system);
  if (!orbit || orbit->events.size() != cycle.orbit.events.size()) return {};
  const drive::FoundCycle found = measured(beside, *orbit, {});
  Answer answer;
  answer.cycles.resize(1);
  Cycle& only = answer.cycles.front();
  only.stability = Stability::stable;
  only.amplitude = found.amplitude;
  only.motor_amplitude = found.motor_amplitude;
  only.center = found.center;
  only.period = found.period();
  return answer;
}

}  // namespace

Jacobian orbit_derivatives(const Drive& drive, const Analysis& analysis,
                           std::span<const Quantity> quantities,
                           const std::vector<std::string>& paths, Progress& progress) {
  const drive::FoundCycle* cycle = cycle_in_practice(analysis);
  Jacobian jacobian = without_slopes(quantities, paths, presents_of(drive, paths),
                                     cycle == nullptr ? Answer{} : analysis.answer);
  if (cycle == nullptr) {
    jacobian.reason = "no limit cycle was found";
    return jacobian;
  }
  const drive::SearchSetting setting = drive::search_setting(analysis.reduced);
  jacobian.reason = obstacle_to_slopes(setting, *cycle);
  if (!jacobian.reason.empty()) return jacobian;
  for (std::size_t j = 0; j < paths.size(); ++j) {
    if (!progress.go_on(static_cast<double>(j) / static_cast<double>(paths.size()))) break;
    const double present = jacobian.present[j];
    if (present == 0.0) continue;
    const Axis axis{.path = paths[j]};
    const DriveAlong along = drives_along(axis, drive);
    set_slopes(jacobian, j,
               [&](double value) { return answer_beside(along(value), setting, *cycle); },
               {.unit = std::abs(present), .first = 1.0 / 128, .halvings = 12});
  }
  return jacobian;
}

std::vector<double> presents_of(const Drive& drive, const std::vector<std::string>& paths) {
  RangeCheck check;
  std::vector<double> presents;
  for (const std::string& path : paths) {
    const Parameter* parameter = find_parameter(path, drive);
    const bool is_number =
        parameter != nullptr && parameter->choices.empty() && number_in(*parameter, drive);
    if (is_number) {
      presents.push_back(*number_in(*parameter, drive));
    } else {
      check.refuse("paths", path, "must be a number that this drive has");
    }
  }
  require_none(check.faults());
  return presents;
}

std::vector<std::string> numbers_of_orbits(const Drive& drive) {
  std::vector<std::string> paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive) || !parameter.choices.empty()) continue;
    const std::optional<double> present = number_in(parameter, drive);
    if (present && *present != 0.0) paths.emplace_back(parameter.path);
  }
  return paths;
}

}  // namespace gearlash
