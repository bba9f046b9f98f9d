#include "general/attractors/search_setting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "general/assemble/time_scale.hpp"
#include "hybrid/turns.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::Matrix;
using hybrid::Vector;

constexpr double full_turn = 2.0 * std::numbers::pi;

// ---- coordinates --------------------------------------------------------------------------------

ReducedDrive with_settled_signals(ReducedDrive drive) {
  drive.reference = settled(drive.reference);
  drive.load_torque = settled(drive.load_torque);
  if (std::holds_alternative<Ramp>(drive.load_torque)) {
    RangeCheck check;
    check.refuse("load_torque", "a ramp",
                 "must end as a constant or a sine: otherwise there are no attractors");
    require_none(check.faults());
  }
  return drive;
}

/// Moves all positions by 1, and the reference if it is a number of the state.
Vector along_positions(const StateIndices& at, bool reference_moves) {
  Vector way = Vector::Zero(at.size);
  way[motor_position] = way[load_position] = 1.0;
  for (const Eigen::Index position : {at.encoder, at.last_reading}) {
    if (position != StateIndices::none) way[position] = 1.0;
  }
  if (reference_moves && at.reference_size > 0) way[at.reference] = 1.0;
  return way;
}

void choose_coordinates(SearchSetting& setting) {
  hybrid::HybridSystem& system = setting.built.system;
  const auto* ramp = std::get_if<Ramp>(&setting.drive.reference);
  const Vector way = along_positions(setting.built.at, ramp != nullptr);
  const Vector nothing = Vector::Zero(system.size());
  setting.frame = {Vector::Ones(system.size()), middle_of(setting.drive.reference) * way, nothing};
  if (ramp == nullptr) return;
  if (is_carried_along(system, way)) {
    setting.coordinates = Coordinates::co_moving;
    setting.frame.drift = ramp->rate * way;
    const Eigen::Index encoder = setting.built.at.encoder;
    if (encoder != StateIndices::none) {
      system.exogenous[static_cast<std::size_t>(encoder)] = false;  // it flows back between counts
    }
  } else {
    setting.coordinates = Coordinates::in_place;
    setting.frame.shift = nothing;
  }
}

void look(SearchSetting& setting) {
  const hybrid::HybridSystem system = seen_in(setting.built.system, setting.frame);
  setting.system = hybrid::PreparedSystem(system);
  const Vector& scale = setting.frame.scale;
  const Eigen::Index size = scale.size();
  const auto watched_at = [&](Eigen::Index position_at, Eigen::Index speed_at) {
    AffineForm position{scale[position_at] * Vector::Unit(size, position_at), 0.0};
    AffineForm speed{scale[speed_at] * Vector::Unit(size, speed_at), 0.0};
    if (const auto* ramp = std::get_if<Ramp>(&setting.drive.reference)) {
      speed.offset = -ramp->rate;  // the numbers hold absolute speeds in all coordinates
    }
    if (setting.coordinates == Coordinates::in_place) {
      const AffineForm& reference = setting.built.reference;
      position.normal -= reference.normal.cwiseProduct(scale);
      position.offset -= reference.offset;
    }
    return watched(system, std::move(position), std::move(speed));
  };
  setting.load = watched_at(load_position, load_speed);
  setting.motor = watched_at(motor_position, motor_speed);
  if (std::holds_alternative<Sine>(setting.drive.reference)) {
    AffineForm error = setting.built.reference;
    error.normal = error.normal.cwiseProduct(scale) - setting.load.value.normal;
    error.offset -= middle_of(setting.drive.reference);
    // The speed of a signal is by its own numbers alone, which every mode moves alike.
    AffineForm speed{
        setting.built.system.mode(0).flow.matrix.transpose() * setting.built.reference.normal, 0.0};
    speed.normal = speed.normal.cwiseProduct(scale) - setting.load.speed.normal;
    setting.error = watched(system, std::move(error), std::move(speed));
  }
  setting.with_turns = hybrid::PreparedSystem(
      hybrid::with_turns(system, setting.load.speed, hybrid::OtherEvents::kept));
}

// ---- lengths ------------------------------------------------------------------------------------

/// Direct gain from position to torque, N m/rad; 0 of a relay, whose torque does not grow with it.
double direct_stiffness(const ReducedDrive& drive) {
  if (drive.error_shape.is_relay()) return 0.0;
  return std::abs(running_controller(drive).direct[1]);
}

/// Of a settled signal that is no ramp.
double highest(const Signal& signal) {
  const auto* sine = std::get_if<Sine>(&signal);
  return std::abs(middle_of(signal)) + (sine != nullptr ? std::abs(sine->amplitude) : 0.0);
}

void measure_lengths(SearchSetting& setting, const StartTolerances& starts) {
  const ReducedDrive& drive = setting.drive;
  constexpr double without_gap = 1e-3;  // rad, a usual backlash, for a drive that has none
  const double gap = drive.backlash > 0.0 ? drive.backlash : without_gap;
  setting.small_length = setting.large_length = gap;
  for (const double step : {drive.sensing.resolution, drive.sensing.resolution_of_speed}) {
    if (step > 0.0) setting.small_length = std::min(setting.small_length, step);
    setting.large_length = std::max(setting.large_length, step);
  }
  const double stiffness = direct_stiffness(drive);
  double amplitude = 0.0;
  if (const auto* sine = std::get_if<Sine>(&drive.reference)) amplitude = std::abs(sine->amplitude);
  std::vector<double> lengths = {amplitude};
  if (!drive.error_shape.is_of_speed) lengths.push_back(drive.error_shape.begins);
  if (stiffness > 0.0) {
    for (const double torque : {drive.motor.friction.breakaway + drive.load.friction.breakaway,
                                highest(drive.load_torque),
                                std::isfinite(drive.torque_limit) ? drive.torque_limit : 0.0}) {
      lengths.push_back(torque / stiffness);
    }
  }
  for (const double length : lengths) {
    setting.large_length =
        std::max(setting.large_length, std::min(length, starts.longest_length * gap));
  }
  lengths.push_back(setting.large_length);
  const double limit = std::min(drive.torque_limit, drive.winding.torque_limit);
  const bool is_bounded = std::isfinite(limit) || drive.error_shape.is_relay();
  if (is_bounded) lengths.push_back(stiffness > 0.0 ? limit / stiffness : infinity);
  setting.farthest_length = *std::max_element(lengths.begin(), lengths.end());
  const double viscous = drive.motor.friction.viscous + drive.load.friction.viscous;
  if (std::isfinite(limit) && viscous > 0.0) {
    setting.braked_length = (drive.motor.inertia + drive.load.inertia) *
                            (limit + highest(drive.load_torque)) / (viscous * viscous);
  }
}

}  // namespace

double held_length(const ReducedDrive& drive) {
  const double stiffness = direct_stiffness(drive);
  if (!(stiffness > 0.0)) return 0.0;
  return (drive.motor.friction.breakaway + drive.load.friction.breakaway) / stiffness;
}

double error_beside(const Extent& motor, const ReducedDrive& drive) {
  if (drive.sensing.load_share_of_position > 0.0) return 0.0;
  const double half_gap = 0.5 * drive.backlash;
  return std::max(std::abs(motor.high - half_gap), std::abs(motor.low + half_gap));
}

bool is_mirrored(const ReducedDrive& drive) {
  const bool is_constant = std::holds_alternative<double>(drive.reference);
  const auto* torque = std::get_if<double>(&drive.load_torque);
  return is_constant && torque != nullptr && *torque == 0.0;
}

bool reads_mirrored(const ReducedDrive& drive) {
  const double twice = 2.0 * middle_of(drive.reference);
  constexpr double rounding = 1e-9;  // of a step
  const auto is_between_steps = [&](double step) {
    return step > 0.0 && std::abs(std::remainder(twice, step)) > rounding * step;
  };
  return !is_between_steps(drive.sensing.resolution) &&
         !is_between_steps(drive.sensing.resolution_of_speed);
}

bool is_own_image(const ReducedDrive& drive) { return is_mirrored(drive) && reads_mirrored(drive); }

hybrid::State SearchSetting::start(const ShaftStates& shafts) const {
  hybrid::State state = drive_start(drive, built, shafts);
  state.numbers = frame.inside(state.numbers, 0.0);
  return state;
}

double SearchSetting::between_ticks(double time) const {
  if (!drive.sampling) return time;
  const double period = drive.sampling->period;
  const double delay = drive.sampling->delay;
  const double aside = delay > 0.5 * period ? 0.5 * delay : 0.5 * (delay + period);
  return std::ceil((time - aside) / period) * period + aside;
}

namespace {

void measure_sines(SearchSetting& setting) {
  Extent frequencies;
  for (const Signal* signal : {&setting.drive.reference, &setting.drive.load_torque}) {
    if (const auto* sine = std::get_if<Sine>(signal)) frequencies.include(sine->frequency);
  }
  if (frequencies.high < frequencies.low) return;
  setting.longest_sine = full_turn / frequencies.low;
  if (frequencies.low == frequencies.high) setting.common_sine = setting.longest_sine;
}

}  // namespace

SearchSetting search_setting(const ReducedDrive& drive, const StartTolerances& starts) {
  require_none(faults(drive));
  SearchSetting setting;
  setting.drive = with_settled_signals(drive);
  setting.built = drive_system(setting.drive);
  setting.own = setting.built.at.own();
  choose_coordinates(setting);
  look(setting);
  const TimeScales times = time_scales(setting.drive);
  setting.swing_time = times.swing;
  measure_sines(setting);
  setting.settling_time = times.settling;
  measure_lengths(setting, starts);
  return setting;
}

SearchSetting scaled(const SearchSetting& setting, const hybrid::Trajectory& motion) {
  SearchSetting result = setting;
  const std::vector<Extent> all = extents(motion, motion.start_time());
  const auto power_of_2 = [](double value) {
    return value > 0.0 && std::isfinite(value) ? std::exp2(std::round(std::log2(value))) : 1.0;
  };
  Vector& scale = result.frame.scale;
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const Extent& range = all[static_cast<std::size_t>(i)];
    scale[i] = power_of_2(std::max(std::abs(range.low), std::abs(range.high)));
  }
  for (const auto& [one, other] :
       {std::pair{motor_position, load_position}, std::pair{motor_speed, load_speed}}) {
    scale[one] = scale[other] = std::max(scale[one], scale[other]);
  }
  look(result);
  return result;
}

namespace {

/// rad from the reference, on one side: where the weight of the load, which pushes on from there,
/// overcomes the torque limit and the dry friction. Infinite of a load that hangs.
double falling_length(const ReducedDrive& drive, double side) {
  const Gravity& gravity = drive.gravity;
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  if (!(gravity.stiffness < 0.0) || load_torque == nullptr) return infinity;
  const double outwards =
      side * (*load_torque - gravity.stiffness * (middle_of(drive.reference) - gravity.angle));
  const double held = std::min(drive.torque_limit, drive.winding.torque_limit) +
                      drive.motor.friction.breakaway + drive.load.friction.breakaway;
  return (held - outwards) / -gravity.stiffness;
}

}  // namespace

std::vector<ShaftStates> usual_starts(const SearchSetting& setting,
                                      const StartTolerances& tolerances) {
  const double low = tolerances.least_step * setting.small_length;
  const double high = tolerances.largest_step * setting.large_length;
  const double steps = tolerances.steps_per_decade * std::log10(high / low);
  const int count = std::min(tolerances.most_steps, static_cast<int>(std::round(steps)));
  const double half_gap = 0.5 * setting.drive.backlash;
  const double reference = middle_of(setting.drive.reference);
  const auto* ramp = std::get_if<Ramp>(&setting.drive.reference);
  const double speed = ramp != nullptr ? ramp->rate : 0.0;
  std::vector<ShaftStates> starts;
  const auto add = [&](double offset, double face) {
    const double load = reference + offset;
    starts.push_back({load + face * half_gap, speed, load, speed});
  };
  const auto add_offsets = [&](double sign, double face) {
    for (int i = 0; i <= count; ++i) {
      add(sign * low * std::pow(high / low, static_cast<double>(i) / count), face);
    }
    constexpr double beyond = 1.2;
    const double falling = beyond * falling_length(setting.drive, sign);
    if (falling > high && std::isfinite(falling)) add(sign * falling, face);
  };
  add_offsets(1.0, -1.0);
  add_offsets(1.0, 1.0);
  if (!is_mirrored(setting.drive)) {
    add_offsets(-1.0, -1.0);
    add_offsets(-1.0, 1.0);
  }
  // A motor that is read is half a gap away at least where it starts on a face. Near by it may hunt
  // alone.
  const ReducedDrive& drive = setting.drive;
  if (drive.sensing.load_share_of_position < 1.0 && drive.motor.friction.is_dry()) {
    const double near = std::max(low, drive.sensing.resolution);
    constexpr double middle = 0.0;
    add(near, middle);
    if (!is_mirrored(drive)) add(-near, middle);
  }
  // From a greater speed the torque limit would let the load pass the largest step.
  const double braking = drive.torque_limit / (drive.motor.inertia + drive.load.inertia);
  const double fastest = std::sqrt(2.0 * braking * high);
  for (const double times : {1.0, 10.0}) {
    const double passing = times * setting.large_length * full_turn / setting.swing_time;
    const double at_speed = speed + std::min(passing, fastest);
    starts.push_back({reference, at_speed, reference, at_speed});
    if (passing >= fastest) break;
  }
  if (speed != 0.0) starts.push_back({reference + half_gap, 0.0, reference, 0.0});
  return starts;
}

}  // namespace gearlash::drive
