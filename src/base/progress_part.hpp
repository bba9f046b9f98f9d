// Reports one part of longer work as a share of the whole.
#pragma once

#include "gearlash/progress.hpp"

namespace gearlash {

/// Reports to `whole` the part of the work between the shares `from` and `to`.
class ProgressPart : public Progress {
 public:
  ProgressPart(Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}
  /// The part after the first `done` of `count` equal ones.
  ProgressPart(Progress& whole, std::size_t done, std::size_t count)
      : ProgressPart(whole, static_cast<double>(done) / static_cast<double>(count),
                     (static_cast<double>(done) + 1.0) / static_cast<double>(count)) {}

  bool go_on(double share, std::size_t bytes = 0) override {
    return whole_.go_on(from_ + share * (to_ - from_), bytes);
  }

 private:
  Progress& whole_;
  double from_;
  double to_;
};

}  // namespace gearlash
