// One part of longer work, told as a share of the whole.
#pragma once

#include "gearlash/progress.hpp"

namespace gearlash {

/// Tells `whole` of work that takes it from the share `from` to the share `to`.
class ProgressPart : public Progress {
 public:
  ProgressPart(Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}

  bool go_on(double share, std::size_t bytes = 0) override {
    return whole_.go_on(from_ + share * (to_ - from_), bytes);
  }

 private:
  Progress& whole_;
  double from_;
  double to_;
};

}  // namespace gearlash
