#include "question/series/toleranced_drive.hpp"

#include <cmath>
#include <set>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"

namespace gearlash {
namespace {

/// The lowest and the highest value that can be drawn, or that they can come arbitrarily close to.
Bounds range_of(const Distribution& distribution) {
  const Bounds drawn = range_of_draws(distribution);
  const Bounds support = support_of(distribution);
  return {std::isinf(support.low) ? drawn.low : support.low,
          std::isinf(support.high) ? drawn.high : support.high};
}

/// The faults of the values drawn for one parameter, taken by itself.
void check_range(RangeCheck& check, const ParameterTolerance& varied, Permitted permitted) {
  if (permitted == Permitted::anything || permitted == Permitted::of_normal_form) return;
  const bool is_share = permitted == Permitted::share;
  const Bounds range = range_of(varied.distribution);
  const Bounds support = support_of(varied.distribution);
  const bool is_too_low = permitted == Permitted::positive ? range.low <= 0.0 : range.low < 0.0;
  const bool is_too_high = is_share && range.high > 1.0;
  if (!is_too_low && !is_too_high) return;
  const bool needs_min = is_too_low && std::isinf(support.low);
  const bool needs_max = is_too_high && std::isinf(support.high);
  const bool may_be_0 = permitted == Permitted::not_negative && !needs_min;
  std::string demand = is_share   ? "must stay within 0 to 1"
                       : may_be_0 ? "must not fall below zero"
                                  : "must stay positive";
  if (needs_min || needs_max) demand += ": give it ";
  if (needs_min) demand += "a min";
  if (needs_max) demand += needs_min ? " and a max" : "a max";
  check.refuse(varied.path, text_of(varied.distribution), demand);
}

/// Says at which values of the varied parameters the faults were found.
void add_place(const TolerancedDrive& drive, std::span<const double> values,
               std::vector<Fault>& found) {
  for (Fault& fault : found) {
    fault.permitted += "; the tolerances permit it where";
    for (std::size_t i = 0; i < values.size(); ++i) {
      fault.permitted +=
          (i == 0 ? " " : ", ") + drive.varied[i].path + " = " + exact_text(values[i]);
    }
  }
}

bool is_number_of(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  return parameter != nullptr && kind_of(*parameter, drive) == ParameterKind::number;
}

/// The numbers that the drive has, for a message.
std::string numbers_of(const Drive& drive) {
  std::string paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const bool is_this = find_parameter(parameter.path, drive) == &parameter;
    if (!is_this || !is_number_of(drive, parameter.path) || !number_in(parameter, drive)) continue;
    paths += (paths.empty() ? "" : ", ") + std::string(parameter.path);
  }
  return paths;
}

/// The faults of each varied parameter, taken by itself.
std::vector<Fault> faults_of_varied(const TolerancedDrive& drive) {
  RangeCheck check;
  std::set<std::string_view> seen;
  for (const ParameterTolerance& varied : drive.varied) {
    if (!is_number_of(drive.nominal, varied.path)) {
      check.refuse(varied.path, text_of(varied.distribution),
                   "must be a number of this drive: " + numbers_of(drive.nominal));
      continue;
    }
    const Parameter& parameter = *find_parameter(varied.path, drive.nominal);
    if (!seen.insert(parameter.path).second) {
      check.refuse(varied.path, text_of(varied.distribution), "must be given once");
    }
    const std::vector<Fault> found = faults(varied.distribution, varied.path);
    check.include(found);
    if (found.empty()) check_range(check, varied, parameter.permitted);
  }
  return check.faults();
}

/// The faults of what does not vary.
std::vector<Fault> faults_of_fixed(const TolerancedDrive& drive) {
  Drive fixed = drive.nominal;
  for (const ParameterTolerance& varied : drive.varied) {
    const bool is_sound =
        is_number_of(fixed, varied.path) && faults(varied.distribution, "").empty();
    if (is_sound) set(fixed, varied.path, mean_of(varied.distribution));
  }
  std::vector<Fault> found = faults(fixed);
  std::erase_if(found, [&](const Fault& fault) {
    return any_of(drive.varied, [&](const auto& varied) {
      const bool is_derived = fault.path != "drive" && fault.path.find('.') == std::string::npos;
      return is_derived || fault.path == varied.path;
    });
  });
  return found;
}

std::vector<Axis> axes_between(const TolerancedDrive& drive,
                               Bounds (*ends_of)(const Distribution&)) {
  return of_each(drive.varied, [&](const ParameterTolerance& varied) {
    const Bounds range = ends_of(varied.distribution);
    return Axis{.path = varied.path, .values = {range.low, range.high}};
  });
}

/// The faults of the first corner that is no valid drive.
std::vector<Fault> faults_of_corners(const TolerancedDrive& drive, const std::vector<Axis>& axes) {
  for (const std::vector<double>& values : corners_of(axes)) {
    std::vector<Fault> found =
        faults(drive_with(drive.nominal, axes, values, Breakaway::keeps_its_ratio));
    if (found.empty()) continue;
    add_place(drive, values, found);
    return found;
  }
  return {};
}

}  // namespace

std::vector<Axis> axes_of(const TolerancedDrive& drive) { return axes_between(drive, range_of); }

Family family_of(const TolerancedDrive& drive) {
  return Family(drive.nominal, axes_of(drive), Breakaway::keeps_its_ratio);
}

bool may_bounce(const TolerancedDrive& drive) {
  const auto* rigid = std::get_if<RigidContact>(&drive.nominal.contact);
  return (rigid != nullptr && rigid->restitution > 0.0) ||
         any_of(drive.varied,
                [](const auto& varied) { return varied.path == "contact.restitution"; });
}

bool is_searched(const TolerancedDrive& drive) {
  const bool are_numbers = all_of(
      drive.varied, [&](const auto& varied) { return is_number_of(drive.nominal, varied.path); });
  return are_numbers && family_of(drive).engines().search;
}

EnclosedCeiling ceiling_of_all(const TolerancedDrive& drive, Quantity amplitude,
                               Progress& progress) {
  const std::vector<BoxSide> box = of_each(drive.varied, [](const ParameterTolerance& varied) {
    return BoxSide{varied.path, three_sigma_range_of(varied.distribution)};
  });
  const bool is_of_motor = amplitude == Quantity::motor_amplitude;
  return enclosed_ceiling(drive.nominal, box,
                          {.quantity = is_of_motor ? Quantity::motor_ceiling : Quantity::ceiling},
                          progress);
}

std::vector<double> means_of(const TolerancedDrive& drive) {
  return of_each(drive.varied,
                 [](const ParameterTolerance& varied) { return mean_of(varied.distribution); });
}

std::vector<Fault> faults(const TolerancedDrive& drive) {
  RangeCheck check;
  check.include(faults_of_varied(drive)).include(faults_of_fixed(drive));
  if (check.faults().empty()) check.include(faults_of_corners(drive, axes_of(drive)));
  if (check.faults().empty()) {
    check.include(faults_of_corners(drive, axes_between(drive, three_sigma_range_of)));
  }
  return check.faults();
}

std::string_view path_of_backlash(const Drive& drive) {
  return drive.servo ? "servo.backlash" : "gearbox.backlash";
}

std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive) {
  const ParameterTolerance* found = first_of(drive.varied, [&](const auto& varied) {
    return varied.path == path_of_backlash(drive.nominal);
  });
  if (found == nullptr) return std::nullopt;
  return static_cast<std::size_t>(found - drive.varied.data());
}

std::string_view unit_of(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  const Dimension* dimension = parameter == nullptr ? nullptr : parameter->dimension(drive);
  return dimension == nullptr ? "1" : dimension->unit;
}

}  // namespace gearlash
