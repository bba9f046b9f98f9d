// How far long work is, and whether it shall go on.
#pragma once

#include <cstddef>

namespace gearlash {

/// Goes into every long function, which calls go_on() now and then, from one thread at a time. A
/// function that is stopped returns what it has and says so; it does not throw.
class Progress {
 public:
  virtual ~Progress() = default;

  /// `share` of the work that is done, 0 … 1; `bytes` that the work holds in memory, as far as it
  /// counts them. False: stop.
  virtual bool go_on(double share, std::size_t bytes = 0) = 0;
};

/// Hears nothing and stops nothing.
[[nodiscard]] Progress& no_progress() noexcept;

}  // namespace gearlash
