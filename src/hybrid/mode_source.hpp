// Makes a mode when a motion first enters it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace gearlash::hybrid {

struct Mode;

/// Modes by number. Each is made when it is first requested, and then kept. The modes of a system
/// of several small automata are the product of their states, and a motion enters few of them.
/// Copies share the modes made. Several threads may use it at a time.
class ModeSource {
 public:
  using Make = std::function<Mode(std::size_t index)>;

  ModeSource() = default;  ///< no source
  /// `make` is called once for each number below `count`, by several threads at a time. It must
  /// always give the same mode for a number.
  ModeSource(std::size_t count, Make make);

  explicit operator bool() const { return store_ != nullptr; }
  std::size_t count() const;  ///< of all possible modes
  std::size_t made() const;   ///< number of modes requested so far
  /// Precondition: index < count(). The reference is valid as long as a copy of the source exists.
  const Mode& mode(std::size_t index) const;

 private:
  struct Store;
  std::shared_ptr<Store> store_;
};

}  // namespace gearlash::hybrid
