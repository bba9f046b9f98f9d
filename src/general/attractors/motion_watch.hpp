// Observations of a motion while it is watched: its swings, whether it rests.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/progress.hpp"
#include "general/attractors/search_setting.hpp"

namespace gearlash::drive {

/// A state of a motion.
struct Mark {
  double time = 0.0;
  hybrid::State here;
};

/// Steps towards rest that shrink by one ratio, each of another duration by one ratio: swings that
/// vanish, slips of a drive that creeps.
struct ShrinkingSteps {
  double final = 0.0;           ///< rad, from the reference: where they end
  double size = 0.0;            ///< rad, of the last: its distance from there
  double ratio = 0.0;           ///< of two successive sizes, below 1
  double duration = 0.0;        ///< s, of the last
  double duration_ratio = 1.0;  ///< of two successive durations
};

struct Watch {
  hybrid::State here;
  double time = 0.0;
  double busy = 0.0;  ///< s, of a motion that is kept: time between events and turns, each limited
  std::size_t events = 0;
  std::vector<Extent> all{};  ///< of each number
  std::vector<Sample> load{};
  std::vector<Sample> motor{};
  std::vector<Sample> error{};   ///< as of SearchSetting
  std::vector<Mark> marks{};     ///< the start of each stretch
  std::vector<Extent> before{};  ///< of each number in the last half of the stretch before
  bool starts_at_rest = false;
  Progress* progress = nullptr;  ///< may stop it
};

/// A motion during a period of a sine. Empty if it is not known.
struct Course {
  std::vector<double> positions{};  ///< rad, of load and motor in turn, at even phases from 0 on
  std::vector<double> means{};      ///< of the drive's own numbers
  std::vector<double> widths{};     ///< of their ranges
};

/// A stretch of a watched motion.
struct Stretch : hybrid::Observed {
  double from = 0.0;
  std::vector<Extent> last{};  ///< of each number in the last half; empty if it did not get there
  /// Of the last period of a sine, and of the one before; of a motion that was observed.
  Course course{};
  Course course_before{};
  std::optional<hybrid::Trajectory> motion{};  ///< empty if it was observed and not kept
};

/// Watches a motion from `watch.here` until a time, a number of events or of steps: adds its ranges
/// and turns to `watch`, and moves that to its end. The motion is kept.
Stretch follow(Watch& watch, double until, std::size_t step_limit, std::size_t event_limit,
               const SearchSetting& setting, const SearchBudget& budget);
/// The same, but nothing is kept of the motion. Suits sampled drives, whose ticks are many. Turns
/// between ticks are those of the cubic through both ends of a step.
Stretch observe(Watch& watch, double until, std::size_t event_limit, const SearchSetting& setting);

/// The middle of the longest time between two events in which a shaft moves, s. Empty if there is
/// none.
std::optional<double> longest_move(const hybrid::Trajectory& motion, const SearchSetting& setting);

/// Whether a stretch ended because events followed each other without end.
bool is_endless(const Stretch& stretch);

/// Whether no number on which the shafts' motion depends at once has moved in the last half of a
/// stretch by more than a share of its total movement. (A controller of high order has others, high
/// derivatives, that never move by less than rounding.) Where events follow each other without end:
/// whether these numbers would change by no more than that within a swing time, because a shaft
/// whose torque comes to rest at its friction's edge stops and breaks away by rounding alone.
bool is_at_rest(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                const RestTolerances& tolerances);

/// Whether, in place, both shafts moved along with the reference during a stretch, to that share of
/// their movement.
bool moves_along(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                 const RestTolerances& tolerances);

/// Whether the load is far beyond all lengths of the drive, those of a torque limit however many
/// backlashes they are; or swings that grow are, each by no less than the one before. Swings of a
/// limited torque against viscous friction must also be beyond SearchSetting::braked_length, below
/// which they cease to grow.
bool has_run_away(const Watch& watch, const SearchSetting& setting,
                  const SearchTolerances& tolerances);

/// Adds a place where the drive came to rest, and its mirror image, if the drive is its own. What
/// is within rounding of the reference is at it.
void add_rest(RestFound& rest, double load, double motor, const SearchSetting& setting,
              const RestTolerances& tolerances);

/// Swings after a time, without negligible ones.
std::size_t count_of_swings(const std::vector<Sample>& turns, double from,
                            const SearchSetting& setting, const RestTolerances& tolerances);

/// Swing between two successive turns, `from_last` swings before the last.
double swing(const std::vector<Sample>& turns, std::size_t from_last);

/// Whether swings are much smaller than the gap, and shrink.
bool is_small(const std::vector<Sample>& turns, const SearchSetting& setting,
              const RestTolerances& tolerances);

/// The load's turns, with the start from rest, and the end if it stands.
std::vector<Sample> turns_of(const Watch& watch, const SearchSetting& setting,
                             const RestTolerances& tolerances);

/// The limit of three numbers that approach it by one ratio (Aitken).
double limit_of(double first, double second, double third);

/// The last of small swings that vanish. In a drive without dry friction, encoder, shaped error and
/// constant torque small motion is the same at any size; so if swings shrink by one ratio (Aitken's
/// extrapolation of any three gives 0), or in a sampled drive by ratios that scatter below 1, they
/// go on. Needs many swings, or a few that shrink fast. Empty otherwise.
std::optional<ShrinkingSteps> vanishing_swings(const std::vector<Sample>& turns,
                                               const SearchSetting& setting,
                                               const RestTolerances& tolerances);

}  // namespace gearlash::drive
