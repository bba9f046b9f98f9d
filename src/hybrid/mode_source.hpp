// Modes that are made when a motion first enters them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace gearlash::hybrid {

struct AffineMode;

/// Modes by number, each made on first use and then kept. A system made of several small automata
/// has the product of their states as modes, and a motion enters few of them. Copies share the
/// modes made. Several threads may use it at a time.
class ModeSource {
 public:
  using Make = std::function<AffineMode(std::size_t index)>;

  ModeSource() = default;  ///< no source
  /// `make` is called at most once for each number below `count`, by several threads at a time. It
  /// must always return the same mode.
  ModeSource(std::size_t count, Make make);

  explicit operator bool() const { return store_ != nullptr; }
  std::size_t count() const;  ///< of all modes, made or not
  std::size_t made() const;   ///< number of modes made so far
  /// Precondition: index < count(). The reference is valid while any copy of the source lives.
  const AffineMode& mode(std::size_t index) const;

 private:
  struct Store;
  std::shared_ptr<Store> store_;
};

}  // namespace gearlash::hybrid
