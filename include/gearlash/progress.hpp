// Reports the progress of long work and lets the caller stop it.
#pragma once

#include <cstddef>

namespace gearlash {

/// Every long function takes one and calls go_on() now and then, from one thread at a time. A
/// function that is stopped returns its partial result, which states so. It does not throw.
class Progress {
 public:
  virtual ~Progress() = default;

  /// `share` of the work is done, 0 … 1. `bytes` is the memory of the work, as far as it counts it.
  /// False: stop.
  virtual bool go_on(double share, std::size_t bytes = 0) = 0;
};

/// Ignores reports and never stops.
[[nodiscard]] Progress& no_progress() noexcept;

}  // namespace gearlash
