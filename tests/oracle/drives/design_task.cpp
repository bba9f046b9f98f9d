#include "design_task.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/on_threads.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "question/axis.hpp"
#include "question/change/target.hpp"
#include "random_drive.hpp"

namespace gearlash::oracle {
namespace {

constexpr int values_on_grid = 9;
constexpr double reach = 5.0;

std::string text_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

constexpr int kinds_of_limits = 7;

/// One limit, of a kind from 0 on.
void add_limit(int kind, SeededDraws& draws, const Drive& drive, DesignTask& task) {
  const double backlash = drive.gearbox.backlash;
  Target& target = task.target;
  const auto limit = [&](const char* name, Quantity quantity, double most) {
    target.require(quantity, {0.0, most});
    task.text += text_of((std::string(name) + " <= %.3g b").c_str(), most / backlash);
  };
  if (!task.text.empty()) task.text += " and ";
  switch (kind) {
    case 0:
      target.no_hunting = true;
      task.text += "no-hunting";
      break;
    case 1:
      target.no_hunting = target.no_hunting_if_disturbed = true;
      task.text += "no-hunting-if-disturbed";
      break;
    case 2:
      target.no_runaway = true;
      task.text += "no-runaway";
      break;
    case 3:
      limit("motor-amplitude", Quantity::motor_amplitude, backlash * draws.log_uniform(0.03, 3.0));
      break;
    case 4:
      limit("ceiling", Quantity::ceiling, backlash * draws.log_uniform(1.0, 100.0));
      break;
    case 5:
      limit("static-error", Quantity::static_error, backlash * draws.log_uniform(0.1, 3.0));
      break;
    default:
      limit("amplitude", Quantity::amplitude, backlash * draws.log_uniform(0.03, 3.0));
  }
}

Drive with(Drive drive, std::string_view path, double value) {
  set(drive, path, value);
  return drive;
}

/// By itself: nothing is followed.
bool meets(const DesignTask& task, double value) {
  const Drive drive = with(task.drive, task.axis.path, value);
  if (!faults(drive).empty()) return false;
  return is_met(task.target, analyse(drive, wanted_for(task.target)));
}

/// Of many values, on all cores.
std::vector<char> meet(const DesignTask& task, const std::vector<double>& values) {
  std::vector<char> met(values.size());
  on_threads(0, values.size(), [&](std::size_t i) { met[i] = meets(task, values[i]) ? 1 : 0; });
  return met;
}

std::vector<double> those_that_miss(const DesignTask& task, const std::vector<double>& values,
                                    DesignCheck& check) {
  const std::vector<char> met = meet(task, values);
  check.judged += values.size();
  std::vector<double> missing;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (met[i] == 0) missing.push_back(values[i]);
  }
  return missing;
}

bool is_listed(const FeasibleValues& found, double value) {
  return found.contains(value) ||
         std::any_of(found.undecided.begin(), found.undecided.end(),
                     [&](const Bounds& part) { return part.contains(value); });
}

void scan(const DesignTask& task, DesignCheck& check) {
  constexpr int finer = 4;
  const Axis dense = logarithmic(task.axis.path, task.axis.values.front(), task.axis.values.back(),
                                 finer * (values_on_grid - 1) + 1);
  const std::vector<char> met = meet(task, dense.values);
  check.judged += dense.values.size();
  int in_a_row = 0;
  for (std::size_t i = 0; i < met.size(); ++i) {
    const bool is_missing = met[i] != 0 && !is_listed(check.found, dense.values[i]);
    in_a_row = is_missing ? in_a_row + 1 : 0;
    if (in_a_row == finer + 1) check.missed.push_back(dense.values[i - finer]);
  }
}

}  // namespace

std::vector<std::string_view> numbers_of(const Drive& drive) {
  constexpr std::array paths = {
      "controller.proportional", "controller.integral",   "controller.derivative",
      "controller.position",     "controller.speed",      "controller.speed_integral",
      "gearbox.backlash",        "motor.inertia",         "load.inertia",
      "motor.friction",          "load.friction",         "load.coulomb",
      "contact.stiffness",       "contact.restitution",   "sampling.delay",
      "sampling.period",         "sensor.counts_per_turn"};
  std::vector<std::string_view> numbers;
  for (const std::string_view path : paths) {
    const Axis axis{.path = std::string(path)};
    if (parameter_of(axis, drive) == nullptr) continue;
    if (present_value(axis, drive).value_or(0.0) > 0.0) numbers.push_back(path);
  }
  return numbers;
}

DesignTask random_design_task(std::uint64_t seed) {
  DesignTask task{.drive = seed % 2 == 0 ? random_drive(seed) : continuous_drive(seed)};
  SeededDraws draws(seed);
  const std::vector<std::string_view> numbers = numbers_of(task.drive);
  const std::string path(
      numbers[static_cast<std::size_t>(draws.uniform(0.0, static_cast<double>(numbers.size())))]);
  const double present = get(task.drive, path);
  const double most = path == "contact.restitution" ? 1.0 : reach * present;
  task.axis = logarithmic(path, present / reach, most, values_on_grid);
  const int kind = static_cast<int>(draws.uniform(0.0, kinds_of_limits));
  add_limit(kind, draws, task.drive, task);
  const int other =
      (kind + 1 + static_cast<int>(draws.uniform(0.0, kinds_of_limits - 1))) % kinds_of_limits;
  if (draws.happens(0.5)) add_limit(other, draws, task.drive, task);
  task.text = path + ": " + task.text;
  return task;
}

DesignCheck checked_design(const DesignTask& task) {
  DesignCheck check{.found = values(task.drive, task.axis, task.target)};
  std::vector<double> ends;
  std::vector<double> inner;
  for (const Bounds& interval : check.found.intervals) {
    ends.push_back(interval.low);
    ends.push_back(interval.high);
    const double width = std::log(interval.high / interval.low);
    if (!(width > 0.0)) continue;
    for (const double share : {1e-3, 0.5, 1.0 - 1e-3}) {
      inner.push_back(interval.low * std::exp(share * width));
    }
  }
  check.values_in_intervals = ends.size() + inner.size();
  check.ends_that_miss = those_that_miss(task, ends, check);
  check.inner_that_miss = those_that_miss(task, inner, check);
  scan(task, check);
  return check;
}

}  // namespace gearlash::oracle
