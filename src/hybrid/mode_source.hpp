// Modes that are made when a motion first enters them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace gearlash::hybrid {

struct AffineMode;

/// Modes by number, each made when it is first asked for, and then kept. The modes of a system that
/// is made of several small automata are the product of their states, of which a motion enters few.
/// Copies share what has been made. May be used by several threads at a time.
class ModeSource {
 public:
  using Make = std::function<AffineMode(std::size_t index)>;

  ModeSource() = default;  ///< no source
  /// `make` is called once for a number below `count`, by several threads at a time, and must give
  /// the same mode always.
  ModeSource(std::size_t count, Make make);

  explicit operator bool() const { return store_ != nullptr; }
  std::size_t count() const;  ///< of the modes that there may be
  std::size_t made() const;   ///< how many have been asked for
  /// Precondition: index < count(). The reference is valid as long as a copy of the source is.
  const AffineMode& mode(std::size_t index) const;

 private:
  struct Store;
  std::shared_ptr<Store> store_;
};

}  // namespace gearlash::hybrid
