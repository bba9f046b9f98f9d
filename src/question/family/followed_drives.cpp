#include "question/family/followed_drives.hpp"

#include <algorithm>

namespace gearlash {
namespace {

/// Whether two drives have motions of one kind, as far as a fresh search is sure to see them. Of
/// irregular motion it is not sure whether it repeats, which alone parts two verdicts.
bool are_alike(const Answer& one, const Answer& other) {
  const auto stable = [](const Answer& answer) {
    return std::count_if(answer.cycles.begin(), answer.cycles.end(),
                         [](const Cycle& cycle) { return cycle.stability == Stability::stable; });
  };
  const auto moves_irregularly = [](const Answer& answer, bool alone) {
    return std::any_of(
        answer.irregular.begin(), answer.irregular.end(),
        [&](const IrregularMotion& motion) { return motion.is_motor_alone == alone; });
  };
  const auto kind = [](Verdict verdict) {
    return verdict == Verdict::hunts_irregularly ? Verdict::hunts : verdict;
  };
  return kind(one.verdict) == kind(other.verdict) && stable(one) == stable(other) &&
         moves_irregularly(one, true) == moves_irregularly(other, true) &&
         moves_irregularly(one, false) == moves_irregularly(other, false);
}

class Run {
 public:
  Run(std::span<const SoundDrive> drives, const Wanted& wanted, const SearchScope& scope,
      const AnswerSink& take, Progress& progress)
      : drives_(drives), wanted_(wanted), scope_(scope), take_(take), progress_(progress) {}

  void answer_all() {
    if (drives_.empty()) return;
    const Analysis first = afresh(0);
    if (drives_.size() == 1) return;
    const Analysis last = afresh(drives_.size() - 1);
    answer_between(0, first, drives_.size() - 1, last);
  }

 private:
  Analysis afresh(std::size_t index) {
    if (is_stopped_) return {};
    return taken(index, analyse_in_full(drives_[index], wanted_, progress_, scope_));
  }

  Analysis taken(std::size_t index, Analysis analysis) {
    if (!take_(index, analysis.answer)) is_stopped_ = true;
    return analysis;
  }

  /// Both ends are answered.
  void answer_between(std::size_t low, const Analysis& at_low, std::size_t high,
                      const Analysis& at_high) {
    if (high - low < 2 || is_stopped_) return;
    if (are_alike(at_low.answer, at_high.answer)) {
      follow(low, at_low, high);
      return;
    }
    const std::size_t middle = low + (high - low) / 2;
    const Analysis at_middle = afresh(middle);
    answer_between(low, at_low, middle, at_middle);
    answer_between(middle, at_middle, high, at_high);
  }

  void follow(std::size_t low, Analysis near, std::size_t high) {
    SearchScope scope = scope_;
    scope.near = &near;
    for (std::size_t index = low + 1; index < high && !is_stopped_; ++index) {
      near = taken(index, analyse_in_full(drives_[index], wanted_, progress_, scope));
    }
  }

  std::span<const SoundDrive> drives_;
  const Wanted& wanted_;
  SearchScope scope_;
  const AnswerSink& take_;
  Progress& progress_;
  bool is_stopped_ = false;
};

}  // namespace

void search_run(std::span<const SoundDrive> drives, const Wanted& wanted, const AnswerSink& take,
                Progress& progress, const SearchScope& scope) {
  Run(drives, wanted, scope, take, progress).answer_all();
}

}  // namespace gearlash
