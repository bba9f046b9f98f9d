// Analysis of a drive: by the closed form where it applies, else by a search.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "gearlash/analyse.hpp"
#include "general/attractors/attractors.hpp"
#include "model/answer_bounds.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {

/// An answer with its engine's intermediate results, for pictures.
struct Analysis {
  Answer answer{};
  drive::ReducedDrive reduced{};             ///< with its signals settled
  std::optional<ProportionalServo> servo{};  ///< of the closed form, with its cycles
  std::optional<LimitCycleAnalysis> closed{};
  std::optional<drive::AttractorSearch> search{};
  bool is_followed = false;  ///< the search followed that of a neighbouring drive
};

/// With what a search begins, and where it may stop.
struct SearchScope {
  /// Of a drive that differs slightly: follow_attractors() is tried first.
  const Analysis* near = nullptr;
  /// Whether an answer that was followed suffices, although its motions are of other kinds.
  std::function<bool(const Answer& followed)> suffices{};
  drive::IsEnough is_enough{};               ///< as of AttractorOptions
  drive::IsEnough may_hurry{};               ///< likewise
  drive::SearchTolerances tolerances{};      ///< likewise
  std::vector<drive::ShaftStates> starts{};  ///< likewise
};

/// Answers for a drive. Only the final value, ramp or sine of a reference or load torque matters.
Analysis analyse_in_full(const SoundDrive& drive, const Wanted& wanted = {},
                         Progress& progress = no_progress(), const SearchScope& scope = {});

/// What is proved of all drives that the drive's data may stand for; empty where nothing is, but
/// for ceilings. `answer`: the drive's own.
std::optional<AnswerBounds> proved_bounds(const Drive& drive, const Answer& answer);

/// Whether every motion ends at rest: cannot_hunt or comes_to_rest.
bool is_at_rest(Verdict verdict);

/// Whether the quantity is computed without the motions that the drive ends in.
bool is_figure(Quantity quantity);

/// Adds to `wanted` what the quantity is of.
void ask_for(Quantity quantity, Wanted& wanted);

/// What is computed without the motions that the drive ends in: ceiling, linear loop and step.
void add_figures(const SoundDrive& drive, const Wanted& wanted, Answer& answer, Progress& progress);

/// The answer that follows from a search. `reduced`: the searched drive.
Answer answer_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced);

}  // namespace gearlash
