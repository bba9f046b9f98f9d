// Measures motion that does not repeat.
#pragma once

#include <string>
#include <vector>

#include "general/attractors/motion_watch.hpp"

namespace gearlash::drive {

/// The last stretch of a motion as irregular motion, without its exponent; or the reason why it is
/// none. The limit of events may have stopped the motion.
struct Irregularity {
  IrregularFound found{};
  std::string reason{};  ///< empty if it is irregular
};
Irregularity irregularity_of(const Watch& watch, const Stretch& stretch,
                             const SearchSetting& setting, const SearchTolerances& tolerances,
                             bool is_out_of_events);

/// Whether a stretch shows what its motion is: its swings are many, or hardly scatter, or repeat to
/// the share `repeating`. A few others may be those of a motion that comes to rest.
bool is_sure(const IrregularFound& found, const IrregularTolerances& tolerances, double repeating);

/// 1/s, the fastest decay of the swings between samples that is not excluded at 95 %: the slope of
/// ln(mean swing) of up to 20 blocks of them against time, by least squares, with Student's t.
/// Swings below a tenth of the whole range do not count. Infinite of fewer than 8 swings; negative
/// if they surely grow.
double fastest_decay(const std::vector<Sample>& samples);

/// Whether swings that decay at that rate fall by no more than `hidden_decay` over the measurement.
bool excludes_decay(double fastest_decay, double watched, const IrregularTolerances& tolerances);

/// A stretch of a motion that is steady.
struct SteadyMotion {
  IrregularFound found;
  std::vector<Extent> ranges;   ///< of each number
  Course course{};              ///< as of Stretch
  bool repeats_course = false;  ///< under a sine
};

/// Whether two have the same statistics: means, and extremes within their scatter; and the drive's
/// own numbers cover the same ranges, to a share of their widths: nothing drifts. The period of a
/// motor that hunts alone depends on where in the gap the load stands, and so may differ more. Of
/// both positions the wider range counts, as of both speeds: a load that creeps within the swings
/// of its motor changes little.
bool is_same(const SteadyMotion& one, const SteadyMotion& other, const SearchSetting& setting,
             const IrregularTolerances& tolerances);

/// Whether under a sine both shafts were in the last period where they were in the one before, to
/// IrregularTolerances::repeating of the amplitude or half an encoder step, and no number drifts.
/// Both halves of the stretch have the same extremes of the load, to steady_statistics.
bool repeats_course(const Watch& watch, const Stretch& stretch, const IrregularFound& found,
                    const SearchSetting& setting, const IrregularTolerances& tolerances);

/// Whether a stretch ends likewise on a steady motion under a sine that repeats its course.
bool runs_along(const Stretch& stretch, const SteadyMotion& known, const SearchSetting& setting,
                const IrregularTolerances& tolerances);

/// Whether both shafts stand under a sine, which moves the controller's numbers alone: over three
/// periods at least, in which these cover the ranges of the stretch before, and nothing but the
/// sine is integrated.
bool stands_while_driven(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                         const SearchTolerances& tolerances);

/// Index of a known one that is nearly the same; their count if there is none.
std::size_t place_among(const std::vector<IrregularFound>& known, const IrregularFound& found,
                        const IrregularTolerances& tolerances);

/// Whether a cycle is stable and lies where an irregular motion moves, to
/// IrregularTolerances::same_ranges: the motion may yet join it.
bool may_join(const IrregularFound& motion, const FoundCycle& cycle,
              const IrregularTolerances& tolerances);

/// Takes motion that swings as a stable cycle does, to CycleTolerances::agreement, for a transient
/// towards it: its starts are those of the cycle, and it is not listed besides.
void take_for_cycles(AttractorSearch& search, const CycleTolerances& tolerances);

}  // namespace gearlash::drive
