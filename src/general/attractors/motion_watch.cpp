#include "general/attractors/motion_watch.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash::drive {

void include_ranges(Watch& watch, const hybrid::Trajectory& stretch) {
  const std::vector<Extent> here = extents(stretch, stretch.start_time());
  if (watch.all.empty()) watch.all = here;
  for (std::size_t i = 0; i < here.size(); ++i) {
    watch.all[i].include(here[i].low);
    watch.all[i].include(here[i].high);
  }
}

void include_turns(Watch& watch, const hybrid::Trajectory& stretch, const SearchSetting& setting,
                   double short_time) {
  const auto add = [&](std::vector<Sample>& all, const Watched& watched) {
    const auto seen = samples(stretch, watched, short_time);
    all.insert(all.end(), seen.begin(), seen.end());
  };
  add(watch.load, setting.load);
  add(watch.motor, setting.motor);
}

bool is_at_rest(const Watch& watch, const hybrid::Trajectory& stretch, const SearchSetting& setting,
                const RestTolerances& tolerances) {
  const std::vector<Extent> last =
      extents(stretch, 0.5 * (stretch.start_time() + stretch.end_time()));
  const hybrid::Vector& scale = setting.frame.scale;
  const double positions =
      std::max({watch.all[motor_position].width(), watch.all[load_position].width(),
                setting.drive.backlash / scale[load_position]});
  const double speeds =
      std::max({watch.all[motor_speed].width(), watch.all[load_speed].width(),
                positions * scale[load_position] / (scale[load_speed] * setting.swing_time)});
  for (std::size_t i = 0; i < static_cast<std::size_t>(setting.own); ++i) {
    const bool is_position = i == motor_position || i == load_position;
    const bool is_speed = i == motor_speed || i == load_speed;
    const double extent = is_position ? positions : is_speed ? speeds : watch.all[i].width();
    if (last[i].width() > tolerances.still * extent) return false;
  }
  return true;
}

std::size_t count_of_swings(const std::vector<Sample>& turns, double from,
                            const SearchSetting& setting, const RestTolerances& tolerances) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const double size = std::abs(turns[i].value - turns[i - 1].value);
    if (turns[i].time > from && size > tolerances.negligible_swing * setting.small_length) ++count;
  }
  return count;
}

double swing(const std::vector<Sample>& turns, std::size_t from_last) {
  const std::size_t last = turns.size() - 1 - from_last;
  return std::abs(turns[last].value - turns[last - 1].value);
}

bool is_small(const std::vector<Sample>& turns, const SearchSetting& setting,
              const RestTolerances& tolerances) {
  return turns.size() > 2 && swing(turns, 0) < tolerances.small_swing * setting.small_length &&
         swing(turns, 0) < swing(turns, 1);
}

std::vector<Sample> turns_of(const Watch& watch, const SearchSetting& setting,
                             const RestTolerances& tolerances) {
  std::vector<Sample> turns = extremes(watch.load);
  if (watch.starts_at_rest) turns.insert(turns.begin(), watch.load.front());
  const double speed = std::abs(setting.load.speed.at(watch.here.numbers));
  const double swing_so_far =
      turns.empty() ? 0.0 : std::abs(watch.load.back().value - turns.back().value);
  if (speed * setting.swing_time < tolerances.standing_speed * swing_so_far) {
    turns.push_back(watch.load.back());
  }
  return turns;
}

std::optional<double> ratio_of_vanishing(const std::vector<Sample>& turns,
                                         const SearchSetting& setting,
                                         const RestTolerances& tolerances) {
  const bool is_dry = setting.drive.motor.friction.is_dry() || setting.drive.load.friction.is_dry();
  if (is_dry || !is_small(turns, setting, tolerances)) return std::nullopt;  // comes to rest
  for (std::size_t count = 2; count < turns.size(); ++count) {
    const double first = swing(turns, count - 1);
    const double second = swing(turns, count - 2);
    if (!(second < first)) return std::nullopt;
    if (count > 2) {
      const double third = swing(turns, count - 3);
      const double change = third - second;
      const double limit = third - change * change / (change - (second - first));
      if (!(change < 0.0) || !(std::abs(limit) < tolerances.vanishing_limit * third)) {
        return std::nullopt;
      }
    }
    if (count >= tolerances.vanishing_swings ||
        swing(turns, 0) < tolerances.vanishing_fast * first) {
      return swing(turns, 0) / swing(turns, 1);
    }
  }
  return std::nullopt;
}

}  // namespace gearlash::drive
