#include "question/family/analysed_line.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace gearlash {
namespace {

/// Where motion is too slow for the first starts to be decided, it is so for the others.
bool is_hopeless(const drive::AttractorSearch& search) {
  constexpr std::size_t enough = 5;
  return search.outcomes.size() >= enough &&
         search.count(drive::MotionEnd::undecided) == search.outcomes.size();
}

}  // namespace

DriveAlong drives_along(const Axis& axis, const Drive& drive) {
  return [&axis, drive](double value) {
    Drive there = drive;
    set_on(axis, there, value);
    return there;
  };
}

AnalysedLine::AnalysedLine(DriveAlong drive, Analyse analyse, std::size_t usual, Progress& progress)
    : drive_(std::move(drive)), analyse_(std::move(analyse)), usual_(usual), progress_(progress) {}

AnalysedLine::AnalysedLine(const DriveAlong& drive, const Wanted& wanted, std::size_t usual,
                           Progress& progress)
    : AnalysedLine(
          drive,
          [drive, wanted](double value, SearchScope scope, Progress& heard) -> Known {
            const std::optional<SoundDrive> there = SoundDrive::of(drive(value));
            if (!there) return nullptr;
            scope.is_enough = is_hopeless;
            return std::make_shared<const Analysis>(analyse_in_full(*there, wanted, heard, scope));
          },
          usual, progress) {}

bool AnalysedLine::Heard::go_on(double share, std::size_t bytes) {
  const std::scoped_lock lock(line_.hearing_);
  const double done = static_cast<double>(line_.evaluations_) + share;
  const double left = std::max(1.0, static_cast<double>(line_.usual_) - done);
  if (!line_.progress_.go_on(done / (done + left), bytes)) line_.is_stopped_ = true;
  return !line_.is_stopped_;
}

AnalysedLine::Known AnalysedLine::analysed(double value, const SearchScope& scope) {
  Known analysis = is_stopped_ ? nullptr : analyse_(value, scope, heard_);
  if (!analysis) return nullptr;
  ++evaluations_;
  const Answer& answer = analysis->answer;
  if (answer.search && !answer.search->is_complete) return nullptr;
  const std::scoped_lock lock(keeping_);
  known_[value] = analysis;
  return analysis;
}

AnalysedLine::Known AnalysedLine::nearest(double value) const {
  const std::scoped_lock lock(keeping_);
  const auto above = known_.lower_bound(value);
  if (above == known_.end()) return known_.empty() ? nullptr : std::prev(above)->second;
  if (above == known_.begin()) return above->second;
  const auto below = std::prev(above);
  return (value - below->first < above->first - value ? below : above)->second;
}

}  // namespace gearlash
