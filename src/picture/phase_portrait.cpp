#include "picture/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/lists.hpp"
#include "general/attractors/search_setting.hpp"
#include "picture/attractor_picture.hpp"

namespace gearlash {
namespace {

/// The roles of ways have the order of BasinKind.
MotionRole role_of(BasinKind kind) {
  return static_cast<MotionRole>(static_cast<int>(MotionRole::to_rest) + static_cast<int>(kind));
}

/// The largest distances of both shafts from the reference, rad and rad/s.
struct Reach {
  double position = 0.0;
  double speed = 0.0;
};

Reach reach_of(const Motion& motion) {
  constexpr int samples = 5000;  // a motor that hunts alone moves for a hundredth of the time
  Reach reach;
  for (int i = 0; i <= samples; ++i) {
    const MotionSample sample = motion.at(motion.end_time() * i / samples);
    const Shafts& shafts = sample.shafts;
    reach.position = std::max({reach.position, std::abs(shafts.load_position - sample.reference),
                               std::abs(shafts.motor_position - sample.reference)});
    reach.speed =
        std::max({reach.speed, std::abs(shafts.load_speed), std::abs(shafts.motor_speed)});
  }
  return reach;
}

/// Whether the motor hunts within the gap while the load hardly moves.
bool is_of_motor(const drive::AttractorSearch& search) {
  constexpr double hardly = 0.05;
  for (const drive::FoundCycle& cycle : search.cycles) {
    if (cycle.starts > 0) return cycle.amplitude < hardly * cycle.motor_amplitude;
  }
  return !search.irregular.empty() && search.irregular.front().is_motor_alone;
}

/// s, of the ways to where starts lead.
double length_of_ways(const drive::AttractorSearch& search) {
  double period = search.swing_time;
  for (const drive::FoundCycle& cycle : search.cycles) period = std::max(period, cycle.period());
  for (const drive::IrregularFound& motion : search.irregular) {
    period = std::max(period, motion.period);
  }
  constexpr double periods = 1.5;
  return periods * period;
}

/// Of the search's starts within the plane at most this many, evenly chosen.
std::vector<const drive::Outcome*> starts_within(const StartPlane& plane,
                                                 const drive::AttractorSearch& search,
                                                 double reference) {
  constexpr std::size_t most = 8;  // more lines would hide the cycles
  std::vector<const drive::Outcome*> within;
  for (const drive::Outcome& outcome : search.outcomes) {
    const drive::ShaftStates& start = outcome.start;
    const double position = plane.is_of_motor ? start.motor_position : start.load_position;
    const double speed = plane.is_of_motor ? start.motor_speed : start.load_speed;
    if (std::abs(position - reference) > plane.position || std::abs(speed) > plane.speed) {
      continue;
    }
    within.push_back(&outcome);
  }
  if (within.size() <= most) return within;
  return of_each(indices(most),
                 [&](std::size_t i) { return within[i * (within.size() - 1) / (most - 1)]; });
}

}  // namespace

std::optional<StartPlane> plane_to_draw(const MotionPicture& cycles,
                                        const drive::ReducedDrive& reduced,
                                        const drive::AttractorSearch& search) {
  if (!std::holds_alternative<double>(reduced.reference) || !(search.swing_time > 0.0)) return {};
  constexpr double far = 8.0;  // times the hunting
  constexpr double margin = 1.3;
  StartPlane plane{.is_of_motor = is_of_motor(search)};
  double hunting = 0.0;
  for (const DrawnMotion& drawn : cycles.motions) {
    const Reach reach = reach_of(drawn.motion);
    if (hunting == 0.0) hunting = reach.position;
    if (reach.position > far * hunting) continue;
    plane.position = std::max(plane.position, margin * reach.position);
    plane.speed = std::max(plane.speed, margin * reach.speed);
  }
  for (const Threshold& threshold : search.thresholds) {
    if (hunting > 0.0 && threshold.from > far * hunting) continue;
    plane.position = std::max(plane.position, 1.5 * margin * threshold.from);
  }
  if (plane.position == 0.0) {
    constexpr double lengths = 5.0;
    plane.position = lengths * std::max({reduced.backlash, reduced.sensing.resolution,
                                         drive::held_length(reduced)});
  }
  if (!(plane.position > 0.0)) return {};
  if (plane.speed == 0.0) {
    plane.speed = plane.position * 2.0 * std::numbers::pi / search.swing_time;
  }
  return plane;
}

bool has_several_basins(const drive::AttractorSearch& search) {
  return any_of(search.outcomes, [&](const drive::Outcome& outcome) {
    return kind_of(outcome.end) != kind_of(search.outcomes.front().end);
  });
}

void add_portrait(MotionPicture& picture, const drive::ReducedDrive& reduced,
                  const drive::AttractorSearch& search, const StartPlane& plane,
                  const Basins* basins) {
  const AngleUnit& angle = picture.drive.angle_unit;
  PhaseWindow window{
      .positions = {-angle.from_radians(plane.position), angle.from_radians(plane.position)},
      .speeds = {-angle.from_radians(plane.speed), angle.from_radians(plane.speed)},
      .is_of_motor = plane.is_of_motor};
  const double reference = std::get<double>(reduced.reference);
  constexpr std::size_t most_events = 40'000;
  for (const drive::Outcome* outcome : starts_within(plane, search, reference)) {
    picture.motions.push_back(
        {.motion = motion_from(reduced, outcome->start, length_of_ways(search), most_events),
         .role = role_of(kind_of(outcome->end))});
  }
  if (basins != nullptr) {
    const std::vector<double>& positions = basins->positions.values;
    const std::vector<double>& speeds = basins->speeds.values;
    for (std::size_t i = 0; i < basins->kinds.size(); ++i) {
      window.starts.push_back({.position = angle.from_radians(positions[i % positions.size()]),
                               .speed = angle.from_radians(speeds[i / positions.size()]),
                               .leads = role_of(basins->kinds[i])});
    }
    for (const MapCurve& curve : basins->borders) {
      window.borders.push_back(of_each(curve, [&](const MapPoint& point) {
        return MapPoint{angle.from_radians(point.x), angle.from_radians(point.y)};
      }));
    }
  }
  picture.window = std::move(window);
}

}  // namespace gearlash
