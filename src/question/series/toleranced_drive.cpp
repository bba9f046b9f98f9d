#include "question/series/toleranced_drive.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "base/range_check.hpp"
#include "gearlash/parameter.hpp"
#include "model/closed_form_number.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "question/final_servo.hpp"

namespace gearlash {
namespace {

/// nullptr if the path is not a number of this drive.
double* place_in(Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr) return nullptr;
  const Slot slot = parameter->slot(drive);
  if (auto* const* number = std::get_if<double*>(&slot)) return *number;
  if (auto* const* given = std::get_if<std::optional<double>*>(&slot)) {
    return &(*given)->emplace((*given)->value_or(1.0));
  }
  return nullptr;
}

std::string paths_of(const Drive& drive) {
  std::string paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive) || !enters_closed_form(drive, parameter.path)) continue;
    paths += (paths.empty() ? "" : ", ") + std::string(parameter.path);
  }
  return paths;
}

/// The values that may be drawn: positive, not negative, or a share. Gains must be positive,
/// because they make the loop stiff; the speed gain may be 0.
Permitted permitted_draws(const Parameter& parameter) {
  switch (parameter.permitted) {
    case Permitted::of_normal_form:
      return parameter.path == "servo.friction_ratio" ? Permitted::share : Permitted::not_negative;
    case Permitted::anything:
      return parameter.path == "controller.derivative" ? Permitted::not_negative
                                                       : Permitted::positive;
    default:
      return parameter.permitted;
  }
}

/// The faults of the values drawn for one parameter, taken by itself.
void check_range(RangeCheck& check, const ParameterTolerance& varied, Permitted permitted) {
  const Bounds range = drawn_range_of(varied.distribution);
  const Bounds support = support_of(varied.distribution);
  const std::string text = text_of(varied.distribution);
  if (permitted == Permitted::share) {
    if (range.low >= 0.0 && range.high <= 1.0) return;
    const bool needs_min = range.low < 0.0 && std::isinf(support.low);
    const bool needs_max = range.high > 1.0 && std::isinf(support.high);
    std::string mend;
    if (needs_min) mend = ": give it a min";
    if (needs_max) mend = needs_min ? ": give it a min and a max" : ": give it a max";
    check.refuse(varied.path, text, "must stay within 0 to 1" + mend);
    return;
  }
  const double low = std::isinf(support.low) ? range.low : support.low;
  if (low > 0.0 || (low == 0.0 && permitted == Permitted::not_negative)) return;
  if (std::isinf(support.low)) {
    check.refuse(varied.path, text, "must stay positive: give it a min");
  } else if (permitted == Permitted::positive) {
    check.refuse(varied.path, text, "must stay positive");
  } else {
    check.refuse(varied.path, text, "must not fall below zero");
  }
}

/// Whether amplitudes are computed per rad of backlash. Larger backlashes are refused.
bool is_taken_apart(double backlash) {
  constexpr double most_backlash = 1e6;  // rad
  return backlash > 0.0 && backlash <= most_backlash;
}

/// Corner number `corner` of the box of `ranges`; bit i selects the end of parameter i.
std::vector<double> corner_of(std::span<const Bounds> ranges, std::size_t corner) {
  std::vector<double> values;
  for (const Bounds& range : ranges) {
    values.push_back((corner & 1U) != 0 ? range.high : range.low);
    corner >>= 1U;
  }
  return values;
}

/// The faults of a drive, including that it has no closed form.
std::vector<Fault> faults_of_servo(const Drive& drive) {
  std::vector<Fault> found = faults(drive);
  if (found.empty() && !closed_form_drive(drive)) {
    found.push_back({"drive", "without a closed form", permitted_with_closed_form, ""});
  }
  return found;
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

/// The faults of the first corner that is no valid drive. Precondition: the parameters are the
/// drive's.
std::vector<Fault> faults_of_corners(const TolerancedDrive& drive, std::span<const Bounds> ranges) {
  detail::DrawnDrive drawn(drive);
  for (std::size_t corner = 0; corner < std::size_t{1} << ranges.size(); ++corner) {
    const std::vector<double> values = corner_of(ranges, corner);
    if (drawn.per_backlash(values)) continue;
    Drive at_corner = drawn.with(values);
    double& backlash = *place_in(at_corner, path_of_backlash(at_corner));
    if (is_taken_apart(backlash)) backlash = 1.0;
    std::vector<Fault> found = faults_of_servo(at_corner);
    add_place(drive, values, found);
    return found;
  }
  return {};
}

/// The faults of each varied parameter, taken by itself.
std::vector<Fault> faults_one_by_one(const TolerancedDrive& drive) {
  RangeCheck check;
  std::set<std::string_view> seen;
  for (const ParameterTolerance& varied : drive.varied) {
    const Parameter* parameter = find_parameter(varied.path, drive.nominal);
    if (parameter == nullptr || !enters_closed_form(drive.nominal, varied.path)) {
      check.refuse(varied.path, text_of(varied.distribution),
                   "must be a number of this drive: " + paths_of(drive.nominal));
      continue;
    }
    if (!seen.insert(parameter->path).second) {
      check.refuse(varied.path, text_of(varied.distribution), "must be given once");
    }
    const std::vector<Fault> found = faults(varied.distribution, varied.path);
    check.include(found);
    if (found.empty()) check_range(check, varied, permitted_draws(*parameter));
  }
  return check.faults();
}

/// The faults of the nominal values of the fixed parameters. A sound value replaces each varied
/// one.
std::vector<Fault> faults_of_nominal(const TolerancedDrive& drive) {
  Drive nominal = drive.nominal;
  for (const ParameterTolerance& varied : drive.varied) {
    constexpr double possible = 0.5;  // is valid for every parameter
    if (double* place = place_in(nominal, varied.path)) *place = possible;
  }
  std::vector<Fault> found = faults_of_servo(nominal);
  // Faults of derived quantities come from the replaced values and mean nothing.
  std::erase_if(found, [](const Fault& fault) {
    return fault.path != "drive" && fault.path.find('.') == std::string::npos;
  });
  return found;
}

bool is_number_of(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr || !parameter->choices.empty()) return false;
  Drive copy = drive;
  return place_in(copy, path) != nullptr;
}

/// The faults of each varied parameter of a searched drive, taken by itself.
std::vector<Fault> faults_of_varied(const TolerancedDrive& drive) {
  RangeCheck check;
  std::set<std::string_view> seen;
  for (const ParameterTolerance& varied : drive.varied) {
    if (!is_number_of(drive.nominal, varied.path)) {
      check.refuse(varied.path, text_of(varied.distribution), "must be a number of this drive");
      continue;
    }
    if (!seen.insert(find_parameter(varied.path, drive.nominal)->path).second) {
      check.refuse(varied.path, text_of(varied.distribution), "must be given once");
    }
    check.include(faults(varied.distribution, varied.path));
  }
  return check.faults();
}

/// A breakaway torque without a tolerance of its own varies with its shaft's Coulomb friction.
void keep_ratio_of_breakaway(const TolerancedDrive& drive, Friction& changed,
                             const Friction& nominal, std::string_view path) {
  const bool is_changed = changed.coulomb != nominal.coulomb && nominal.coulomb > 0.0;
  if (!changed.breakaway || !is_changed) return;
  const bool is_varied =
      std::any_of(drive.varied.begin(), drive.varied.end(), [&](const ParameterTolerance& varied) {
        const Parameter* parameter = find_parameter(varied.path, drive.nominal);
        return parameter != nullptr && parameter->path == path;
      });
  if (is_varied) return;
  // Rounding must not make it the smaller of the two.
  changed.breakaway =
      std::max(*changed.breakaway * (changed.coulomb / nominal.coulomb), changed.coulomb);
}

/// Of many parameters only the ends of each are tried, the others being at their means.
std::vector<std::vector<double>> corners_to_try(const TolerancedDrive& drive,
                                                std::span<const Bounds> ranges) {
  constexpr std::size_t most_parameters = 10;
  std::vector<std::vector<double>> all;
  if (ranges.size() <= most_parameters) {
    for (std::size_t corner = 0; corner < std::size_t{1} << ranges.size(); ++corner) {
      all.push_back(corner_of(ranges, corner));
    }
    return all;
  }
  const std::vector<double> means = means_of(drive);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    for (const double end : {ranges[i].low, ranges[i].high}) {
      all.push_back(means);
      all.back()[i] = end;
    }
  }
  return all;
}

std::vector<Fault> faults_of_searched(const TolerancedDrive& drive) {
  std::vector<Fault> found = faults_of_varied(drive);
  if (!found.empty()) return found;
  for (const auto& range_of : {drawn_range_of, three_sigma_range_of}) {
    std::vector<Bounds> ranges;
    for (const ParameterTolerance& varied : drive.varied) {
      ranges.push_back(range_of(varied.distribution));
    }
    for (const std::vector<double>& values : corners_to_try(drive, ranges)) {
      found = faults(searched_drive_with(drive, values));
      if (found.empty()) continue;
      add_place(drive, values, found);
      return found;
    }
  }
  return found;
}

}  // namespace

bool may_bounce(const TolerancedDrive& drive) {
  const auto* rigid = std::get_if<RigidContact>(&drive.nominal.contact);
  return (rigid != nullptr && rigid->restitution > 0.0) ||
         std::any_of(drive.varied.begin(), drive.varied.end(),
                     [](const auto& varied) { return varied.path == "contact.restitution"; });
}

bool is_searched(const TolerancedDrive& drive) {
  if (faults(drive.nominal).empty() && !closed_form_drive(drive.nominal)) return true;
  return std::any_of(drive.varied.begin(), drive.varied.end(),
                     [&](const ParameterTolerance& varied) {
                       return is_number_of(drive.nominal, varied.path) &&
                              !enters_closed_form(drive.nominal, varied.path);
                     });
}

Drive searched_drive_with(const TolerancedDrive& drive, std::span<const double> values) {
  Drive changed = drive.nominal;
  for (std::size_t i = 0; i < values.size(); ++i) set(changed, drive.varied[i].path, values[i]);
  keep_ratio_of_breakaway(drive, changed.motor.friction, drive.nominal.motor.friction,
                          "motor.breakaway");
  keep_ratio_of_breakaway(drive, changed.load.friction, drive.nominal.load.friction,
                          "load.breakaway");
  return changed;
}

EnclosedCeiling ceiling_of_all(const TolerancedDrive& drive, Quantity amplitude,
                               Progress& progress) {
  std::vector<BoxSide> box;
  for (const ParameterTolerance& varied : drive.varied) {
    box.push_back({varied.path, three_sigma_range_of(varied.distribution)});
  }
  const bool is_of_motor = amplitude == Quantity::motor_amplitude;
  return enclosed_ceiling(drive.nominal, box,
                          {.quantity = is_of_motor ? Quantity::motor_ceiling : Quantity::ceiling},
                          progress);
}

std::vector<double> means_of(const TolerancedDrive& drive) {
  std::vector<double> means;
  for (const ParameterTolerance& varied : drive.varied) {
    means.push_back(mean_of(varied.distribution));
  }
  return means;
}

std::vector<Fault> faults(const TolerancedDrive& drive) {
  return is_searched(drive) ? faults_of_searched(drive) : faults_of_toleranced_servo(drive);
}

std::vector<Fault> faults_of_toleranced_servo(const TolerancedDrive& given) {
  RangeCheck check;
  TolerancedDrive drive = given;
  const std::vector<Fault> of_nominal = faults_of_nominal(drive);
  if (of_nominal.empty()) drive.nominal = without_ended_signals(drive.nominal);
  // A faulty drive may still have the form of a servo; then its tolerances are checked too.
  if (of_nominal.empty() || drive::proportional_drivetrain(reduce(drive.nominal))) {
    check.include(faults_one_by_one(drive));
  }
  check.include(of_nominal);
  if (!check.faults().empty()) return check.faults();
  std::vector<Bounds> drawn;
  std::vector<Bounds> possible;
  for (const ParameterTolerance& varied : drive.varied) {
    drawn.push_back(drawn_range_of(varied.distribution));
    possible.push_back(three_sigma_range_of(varied.distribution));
  }
  check.include(faults_of_corners(drive, drawn));
  if (check.faults().empty()) check.include(faults_of_corners(drive, possible));
  return check.faults();
}

std::string_view path_of_backlash(const Drive& drive) {
  return drive.servo ? "servo.backlash" : "gearbox.backlash";
}

std::optional<std::size_t> place_of_backlash(const TolerancedDrive& drive) {
  const auto found = std::find_if(
      drive.varied.begin(), drive.varied.end(),
      [&](const auto& varied) { return varied.path == path_of_backlash(drive.nominal); });
  if (found == drive.varied.end()) return std::nullopt;
  return static_cast<std::size_t>(found - drive.varied.begin());
}

std::string_view unit_of(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  const Dimension* dimension = parameter == nullptr ? nullptr : parameter->dimension(drive);
  return dimension == nullptr ? "1" : dimension->unit;
}

namespace detail {

DrawnDrive::DrawnDrive(const TolerancedDrive& toleranced)
    : drive_(toleranced.nominal), backlash_(place_in(drive_, path_of_backlash(drive_))) {
  for (const ParameterTolerance& varied : toleranced.varied) {
    places_.push_back(place_in(drive_, varied.path));
    if (places_.back() == nullptr) {
      throw std::invalid_argument(varied.path + " is not a number of this drive");
    }
  }
}

const Drive& DrawnDrive::with(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) *places_[i] = values[i];
  return drive_;
}

std::optional<DrivePerBacklash> DrawnDrive::per_backlash(std::span<const double> values) {
  with(values);
  const double backlash = *backlash_;
  DrivePerBacklash result{.backlash = backlash};
  if (drive_.servo) {
    result.drive = normal_form_servo(drive_);
  } else {
    const Drivetrain drivetrain = referred_drivetrain(drive_);
    result.drive = {normalize_sound(drivetrain), natural_frequency(drivetrain), false};
  }
  if (is_taken_apart(backlash)) result.drive.servo.backlash = 1.0;
  if (!faults(result.drive.servo).empty()) return std::nullopt;
  return result;
}

}  // namespace detail
}  // namespace gearlash
