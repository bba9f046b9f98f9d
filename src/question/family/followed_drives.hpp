// Searches drives that differ little from one to the next.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "model/sound_drive.hpp"
#include "question/analyse.hpp"

namespace gearlash {

/// The longest run of neighbours of which only the ends are certain to be searched afresh.
inline constexpr std::size_t longest_run = 32;

/// Receives the answer of drive number `index`; false: stop.
using AnswerSink = std::function<bool(std::size_t index, const Answer& answer)>;

/// Answers in any order, each once. The first and the last drive are searched afresh. Where they
/// have motions of one kind, those between are followed from neighbour to neighbour
/// (follow_attractors()), else the drive half-way is searched afresh too, and so on. Something that
/// appears and vanishes again between two drives searched afresh may be missed. Precondition:
/// drives that need a search.
/// `scope`: of each, less the drive to be followed.
void search_run(std::span<const SoundDrive> drives, const Wanted& wanted, const AnswerSink& take,
                Progress& progress, const SearchScope& scope = {});

}  // namespace gearlash
