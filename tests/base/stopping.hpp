// Stops long work, for tests of what it gives then.
#pragma once

#include <cstddef>
#include <limits>

#include "gearlash/progress.hpp"

namespace gearlash::test {

class Stopping : public Progress {
 public:
  /// When it is asked the `most`-th time.
  explicit Stopping(std::size_t most = 1) : most_(most) {}

  /// When this share of the work is done.
  static Stopping at(double share) {
    Stopping stopping(std::numeric_limits<std::size_t>::max());
    stopping.share_ = share;
    return stopping;
  }

  bool go_on(double share, std::size_t /*bytes*/) override {
    heard = share;
    return ++asked < most_ && share < share_;
  }

  std::size_t asked = 0;
  double heard = 0.0;  ///< share, at last

 private:
  std::size_t most_;
  double share_ = std::numeric_limits<double>::infinity();
};

}  // namespace gearlash::test
