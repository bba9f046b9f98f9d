#include "general/attractors/search_setting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/range_check.hpp"
#include "general/assemble/time_scale.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::Matrix;
using hybrid::Vector;

constexpr double turn = 2.0 * std::numbers::pi;

// ---- coordinates --------------------------------------------------------------------------------

Drive with_settled_signals(Drive drive) {
  drive.reference = settled(drive.reference);
  drive.load_torque = settled(drive.load_torque);
  if (std::holds_alternative<Ramp>(drive.load_torque)) {
    RangeCheck check;
    check.refuse("load_torque", "a ramp",
                 "must be constant or a sine in the end: there are no attractors else");
    require_none(check.violations());
  }
  return drive;
}

bool begins_with(const std::string& name, const char* beginning) {
  return name.rfind(beginning, 0) == 0;
}

Eigen::Index own_numbers(const std::vector<std::string>& names) {
  const auto first = std::find_if(names.begin(), names.end(), [](const std::string& name) {
    return begins_with(name, "reference") || begins_with(name, "load torque");
  });
  return first - names.begin();
}

/// All positions by 1, and the reference where it is a number of the state.
Vector along_positions(const std::vector<std::string>& names, bool reference_moves) {
  Vector way = Vector::Zero(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (name == "motor position" || name == "load position" || name == "encoder" ||
        name == "last reading" || (reference_moves && name == "reference")) {
      way[static_cast<Eigen::Index>(i)] = 1.0;
    }
  }
  return way;
}

double middle_of(const Signal& settled_signal) {
  if (const auto* sine = std::get_if<Sine>(&settled_signal)) return sine->mean;
  return value_at(settled_signal, 0.0);
}

void choose_coordinates(SearchSetting& setting) {
  const hybrid::HybridSystem& system = setting.built.system;
  const auto* ramp = std::get_if<Ramp>(&setting.drive.reference);
  const Vector way = along_positions(system.state_names, ramp != nullptr);
  const Vector nothing = Vector::Zero(system.size());
  setting.frame = {Vector::Ones(system.size()), middle_of(setting.drive.reference) * way, nothing};
  if (ramp == nullptr) return;
  if (is_carried_along(system, way)) {
    setting.coordinates = Coordinates::co_moving;
    setting.frame.drift = ramp->rate * way;
  } else {
    setting.coordinates = Coordinates::in_place;
    setting.frame.shift = nothing;
  }
}

void look(SearchSetting& setting) {
  setting.system = seen_in(setting.built.system, setting.frame);
  const Vector& scale = setting.frame.scale;
  const Eigen::Index size = scale.size();
  const auto watched = [&](Eigen::Index position, Eigen::Index speed) {
    Watched result{{scale[position] * Vector::Unit(size, position), 0.0},
                   {scale[speed] * Vector::Unit(size, speed), 0.0}};
    if (const auto* ramp = std::get_if<Ramp>(&setting.drive.reference)) {
      result.speed.offset = -ramp->rate;  // speeds are what they are in all coordinates
    }
    if (setting.coordinates == Coordinates::in_place) {
      const AffineForm& reference = setting.built.reference;
      result.value.normal -= reference.normal.cwiseProduct(scale);
      result.value.offset -= reference.offset;
    }
    return result;
  };
  setting.load = watched(load_position, load_speed);
  setting.motor = watched(motor_position, motor_speed);
}

// ---- lengths ------------------------------------------------------------------------------------

/// Torque by position at once, N m/rad.
double direct_stiffness(const Drive& drive) {
  const LinearController controller = drive.sampling
                                          ? sampled_controller(drive.controller, *drive.sampling)
                                          : linear_controller(drive.controller);
  return std::abs(controller.direct[1]);
}

void measure_lengths(SearchSetting& setting) {
  const Drive& drive = setting.drive;
  setting.small_length = setting.large_length = drive.backlash;
  for (const double step : {drive.sensing.resolution, drive.sensing.resolution_of_speed}) {
    if (step > 0.0) setting.small_length = std::min(setting.small_length, step);
    setting.large_length = std::max(setting.large_length, step);
  }
  const double stiffness = direct_stiffness(drive);
  double amplitude = 0.0;
  if (const auto* sine = std::get_if<Sine>(&drive.reference)) amplitude = std::abs(sine->amplitude);
  std::vector<double> lengths = {amplitude};
  if (stiffness > 0.0) {
    double load_torque = std::abs(middle_of(drive.load_torque));
    if (const auto* sine = std::get_if<Sine>(&drive.load_torque)) {
      load_torque += std::abs(sine->amplitude);
    }
    for (const double torque :
         {drive.motor.friction.breakaway + drive.load.friction.breakaway, load_torque,
          std::isfinite(drive.torque_limit) ? drive.torque_limit : 0.0}) {
      lengths.push_back(torque / stiffness);
    }
  }
  // What is ten thousand times the backlash is of no interest to it.
  constexpr double most = 1e4;
  for (const double length : lengths) {
    setting.large_length = std::max(setting.large_length, std::min(length, most * drive.backlash));
  }
}

bool is_mirrored(const Drive& drive) {
  const bool is_constant = std::holds_alternative<double>(drive.reference);
  const auto* torque = std::get_if<double>(&drive.load_torque);
  return is_constant && torque != nullptr && *torque == 0.0;
}

}  // namespace

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

SearchSetting search_setting(const Drive& drive) {
  require_none(validate(drive));
  SearchSetting setting;
  setting.drive = with_settled_signals(drive);
  setting.built = drive_system(setting.drive);
  setting.own = own_numbers(setting.built.system.state_names);
  choose_coordinates(setting);
  look(setting);
  const TimeScales times = time_scales(setting.drive);
  setting.swing_time = times.swing;
  setting.settling_time = times.settling;
  measure_lengths(setting);
  return setting;
}

SearchSetting scaled(const SearchSetting& setting, const hybrid::Trajectory& motion) {
  SearchSetting result = setting;
  const std::vector<Range> all = ranges(motion, motion.start_time());
  const auto power_of_2 = [](double value) {
    return value > 0.0 && std::isfinite(value) ? std::exp2(std::round(std::log2(value))) : 1.0;
  };
  Vector& scale = result.frame.scale;
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const Range& range = all[static_cast<std::size_t>(i)];
    scale[i] = power_of_2(std::max(std::abs(range.lowest), std::abs(range.highest)));
  }
  for (const auto& [one, other] :
       {std::pair{motor_position, load_position}, std::pair{motor_speed, load_speed}}) {
    scale[one] = scale[other] = std::max(scale[one], scale[other]);
  }
  look(result);
  return result;
}

std::vector<ShaftStates> usual_starts(const SearchSetting& setting) {
  const double low = 1e-2 * setting.small_length;
  const double high = 1e2 * setting.large_length;
  constexpr double steps_per_decade = 2.0;
  constexpr int most = 16;
  const int count =
      std::min(most, static_cast<int>(std::round(steps_per_decade * std::log10(high / low))));
  const double half_gap = 0.5 * setting.drive.backlash;
  const double reference = middle_of(setting.drive.reference);
  const auto* ramp = std::get_if<Ramp>(&setting.drive.reference);
  const double speed = ramp != nullptr ? ramp->rate : 0.0;
  std::vector<ShaftStates> starts;
  const auto add_offsets = [&](double sign, double face) {
    for (int i = 0; i <= count; ++i) {
      const double offset = sign * low * std::pow(high / low, static_cast<double>(i) / count);
      const double load = reference + offset;
      starts.push_back({load + face * half_gap, speed, load, speed});
    }
  };
  add_offsets(1.0, -1.0);
  add_offsets(1.0, 1.0);
  if (!is_mirrored(setting.drive)) {
    add_offsets(-1.0, -1.0);
    add_offsets(-1.0, 1.0);
  }
  for (const double times : {1.0, 10.0}) {
    const double passing = speed + times * setting.large_length * turn / setting.swing_time;
    starts.push_back({reference, passing, reference, passing});
  }
  if (speed != 0.0) starts.push_back({reference + half_gap, 0.0, reference, 0.0});
  return starts;
}

}  // namespace gearlash::drive
