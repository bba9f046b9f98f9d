// The drives along a line, each analysed once: afresh, or followed from one beside it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "question/analyse.hpp"
#include "question/axis.hpp"

namespace gearlash {

/// The drives along a line, one for each number; called from several threads at a time.
using DriveAlong = std::function<Drive(double)>;
/// Copies of the drive with values of the axis. The axis must outlive them.
DriveAlong drives_along(const Axis& axis, const Drive& drive);

/// From several threads at a time.
class AnalysedLine {
 public:
  using Known = std::shared_ptr<const Analysis>;
  /// Analyses the drive at a value, perhaps from one beside it; nullptr for an unsound drive, and
  /// where it was stopped.
  using Analyse = std::function<Known(double value, const SearchScope& scope, Progress& progress)>;

  /// By `analyse`. `usual`: the number of analyses that are expected, for the progress alone.
  AnalysedLine(DriveAlong drive, Analyse analyse, std::size_t usual, Progress& progress);
  /// By analyse_in_full(). Where the first five starts are undecided the others are left out.
  AnalysedLine(const DriveAlong& drive, const Wanted& wanted, std::size_t usual,
               Progress& progress);

  const DriveAlong& drive() const { return drive_; }
  std::size_t evaluations() const { return evaluations_; }
  bool is_stopped() const { return is_stopped_; }
  /// For other work along the line.
  Progress& progress() { return heard_; }

  /// nullptr for an unsound drive, and where the work was stopped.
  Known afresh(double value) { return analysed(value, {}); }
  /// Followed from an analysis beside it. `suffices`: as of SearchScope.
  Known followed(double value, const Known& near,
                 const std::function<bool(const Answer&)>& suffices = {}) {
    return analysed(value, {.near = near.get(), .suffices = suffices});
  }
  /// The one nearest to a value, or nullptr.
  Known nearest(double value) const;
  /// What is known by now, by value. Not while others analyse.
  const std::map<double, Known>& known() const { return known_; }

 private:
  /// Asks whether to go on.
  class Heard : public Progress {
   public:
    explicit Heard(AnalysedLine& line) : line_(line) {}
    bool go_on(double share, std::size_t bytes = 0) override;

   private:
    AnalysedLine& line_;
  };

  Known analysed(double value, const SearchScope& scope);

  DriveAlong drive_;
  Analyse analyse_;
  std::size_t usual_;
  Progress& progress_;
  Heard heard_{*this};
  std::map<double, Known> known_;
  mutable std::mutex keeping_;
  std::mutex hearing_;
  std::atomic<std::size_t> evaluations_ = 0;
  std::atomic<bool> is_stopped_ = false;
};

}  // namespace gearlash
