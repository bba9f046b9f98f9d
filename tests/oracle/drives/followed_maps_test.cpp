// Maps, whose drives are followed from neighbour to neighbour, beside searches of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/traced_draws.hpp"
#include "design_task.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"

namespace gearlash::oracle::followed_maps_test {
namespace {

struct Map {
  Grid grid{};
  std::string text{};
};

constexpr std::array examples = {"first-servo",
                                 "telescope-axis",
                                 "products/maxon-re40-gp42c",
                                 "products/harmonic-drive-csg-25-100",
                                 "products/t-motor-ak80-6",
                                 "products/faulhaber-1524-16-7",
                                 "dynamixel-joint",
                                 "robot-joint",
                                 "symptoms/joint"};

Drive example(const std::string& name) {
  return read_drive(std::string(GEARLASH_SOURCE_DIRECTORY) + "/examples/" + name + ".toml");
}

Axis axis_about(const Drive& drive, std::string_view path, double reach, std::size_t count) {
  const double present = get(drive, path);
  const double most =
      path == "contact.restitution" ? std::min(1.0, reach * present) : reach * present;
  return logarithmic(path, present / reach, most, count);
}

/// Each number is multiplied by a factor from a half to two, where the drive permits it.
Drive varied(Drive drive, SeededDraws& draws) {
  for (const std::string_view path : numbers_of(drive)) {
    Drive other = drive;
    set(other, path, get(drive, path) * draws.log_uniform(0.5, 2.0));
    if (faults(other).empty()) drive = std::move(other);
  }
  return drive;
}

/// Of even numbers of an example, of odd ones of a drive at random about it: two of its numbers,
/// from a third of the present ones to three times, two lines of 20.
Map random_map(std::size_t number, SeededDraws& draws) {
  Map map;
  map.text = examples[number / 2 % examples.size()];
  map.grid.drive = example(map.text);
  if (number % 2 == 1) {
    map.grid.drive = varied(map.grid.drive, draws);
    map.text += ", varied,";
  }
  std::vector<std::string_view> numbers = numbers_of(map.grid.drive);
  const auto draw = [&] {
    const auto place =
        static_cast<std::size_t>(draws.uniform(0.0, static_cast<double>(numbers.size())));
    const std::string_view path = numbers[place];
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(place));
    return path;
  };
  constexpr double reach = 3.0;
  for (const std::size_t count : {2U, 20U}) {
    const std::string_view path = draw();
    map.grid.axes.push_back(axis_about(map.grid.drive, path, reach, count));
    map.text += " " + std::string(path);
  }
  return map;
}

/// What a map says of a point.
struct PointOfMap {
  Verdict verdict = Verdict::undecided;
  double amplitude = 0.0;
  double motor_amplitude = 0.0;
  double period = 0.0;
  double multiplier = 0.0;  ///< NaN where no cycle was closed
};

constexpr std::array asked = {Quantity::amplitude, Quantity::motor_amplitude, Quantity::period,
                              Quantity::multiplier};

bool is_near(double one, double other, double share) {
  if (std::isnan(one) || std::isnan(other)) return std::isnan(one) && std::isnan(other);
  return std::abs(one - other) <= share * std::max(std::abs(one), std::abs(other));
}

/// Cycles are closed to far less than this.
constexpr double of_a_cycle = 1e-6;
/// The extent of irregular motion depends on how long it is watched.
constexpr double of_irregular_motion = 0.1;

bool is_equal(const PointOfMap& point, const Answer& own) {
  if (point.verdict != own.verdict) return false;
  const bool is_cycle = own.largest_stable() != nullptr || own.irregular.empty();
  const double share = is_cycle ? of_a_cycle : of_irregular_motion;
  const auto value = [&](Quantity quantity) { return own.value(quantity).value_or(NAN); };
  return is_near(point.amplitude, value(Quantity::amplitude), share) &&
         is_near(point.motor_amplitude, value(Quantity::motor_amplitude), share) &&
         (!is_cycle || is_near(point.period, value(Quantity::period), share));
}

/// A motion that was measured, and not closed, may be a cycle of several of its swings.
bool is_same(const PointOfMap& point, const Cycle& cycle) {
  if (!std::isnan(point.multiplier)) {
    return is_near(point.amplitude, cycle.amplitude, of_a_cycle) &&
           is_near(point.period, cycle.period, of_a_cycle);
  }
  const double swings = std::round(cycle.period / point.period);
  return is_near(point.amplitude, cycle.amplitude, of_irregular_motion) &&
         is_near(swings * point.period, cycle.period, of_irregular_motion);
}

/// Whether what the map shows is one of the motions that the search found.
bool is_listed(const PointOfMap& point, const Answer& own) {
  if (point.amplitude == 0.0 && point.motor_amplitude == 0.0) return own.rest.has_value();
  return std::any_of(own.cycles.begin(), own.cycles.end(),
                     [&](const Cycle& cycle) {
                       return cycle.stability != Stability::unstable && is_same(point, cycle);
                     }) ||
         std::any_of(own.irregular.begin(), own.irregular.end(), [&](const IrregularMotion& one) {
           return is_near(point.amplitude, one.amplitude, of_irregular_motion);
         });
}

std::string text_of(const PointOfMap& point, const Answer& own) {
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, " %.6g", value);
    return std::string(text);
  };
  std::string text = std::string("map: ") + name_of(point.verdict) + number(point.amplitude) +
                     number(point.period) + "; alone: " + name_of(own.verdict);
  for (const Cycle& cycle : own.cycles) {
    text += std::string(", ") + name_of(cycle.stability) + number(cycle.amplitude) +
            number(cycle.period);
  }
  for (const IrregularMotion& motion : own.irregular) {
    text += ", irregular" + number(motion.amplitude);
  }
  return text;
}

struct Counts {
  std::size_t points = 0, hunting = 0, equal = 0, of_another_attractor = 0;
};

/// Compares some of the map's points, drawn without repetition.
void compare(const Map& map, std::size_t points, SeededDraws& draws, Counts& counts) {
  const Table table = evaluate(map.grid, asked);
  std::vector<std::size_t> rows(map.grid.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  for (std::size_t i = 0; i < points; ++i) {
    const double left = static_cast<double>(rows.size() - i);
    std::swap(rows[i], rows[i + static_cast<std::size_t>(draws.uniform(0.0, left))]);
    const std::size_t row = rows[i];
    const Drive drive = map.grid.at(row);
    if (!faults(drive).empty()) continue;
    const PointOfMap point{.verdict = table.verdict(row),
                           .amplitude = table[Quantity::amplitude][row],
                           .motor_amplitude = table[Quantity::motor_amplitude][row],
                           .period = table[Quantity::period][row],
                           .multiplier = table[Quantity::multiplier][row]};
    const Answer own = analyse(drive);
    ++counts.points;
    counts.hunting += point.amplitude > 0.0 ? 1U : 0U;
    if (is_equal(point, own)) {
      ++counts.equal;
    } else if (is_listed(point, own)) {
      ++counts.of_another_attractor;
      std::printf("%s, point %zu: another attractor: %s\n", map.text.c_str(), row,
                  text_of(point, own).c_str());
    } else {
      ADD_FAILURE() << map.text << ", point " << row << ": " << text_of(point, own);
    }
  }
}

/// GEARLASH_MAPS=20 asks for more (docs/explanation/verification.md).
TEST(PropertyFollowedMaps, HaveTheAnswersOfSearchesOfTheirOwn) {
  const char* asked_for = std::getenv("GEARLASH_MAPS");
  const std::size_t maps = asked_for == nullptr ? 2 : std::strtoul(asked_for, nullptr, 10);
  const std::size_t points = asked_for == nullptr ? 10 : 25;
  TracedDraws draws(4503);
  Counts counts;
  for (std::size_t number = 0; number < maps; ++number) {
    const Map map = random_map(number, draws);
    compare(map, points, draws, counts);
    std::printf(
        "%s; points so far: %zu, of them hunting: %zu, equal: %zu, of another attractor: %zu\n",
        map.text.c_str(), counts.points, counts.hunting, counts.equal, counts.of_another_attractor);
    std::fflush(stdout);
  }
  EXPECT_GT(counts.equal, counts.points * 9 / 10);
}

}  // namespace
}  // namespace gearlash::oracle::followed_maps_test
