// A sampled drive from one tick of its computer to the next.
#pragma once

#include <cstddef>
#include <vector>

#include "model/linear_drive.hpp"

namespace gearlash {

/// Σ row[i] forms[i]; without forms a form of `size` states. An exact 0 in the row counts nothing.
template <class Number>
LinearForm<Number> combination(const std::vector<Number>& row,
                               const std::vector<LinearForm<Number>>& forms, std::size_t size);

/// A part of a hold, under one torque, with all forms of the numbers at the tick before.
template <class Number>
struct HeldPart {
  Number from{0.0};  ///< s after the tick
  Number length{0.0};
  std::vector<LinearForm<Number>> states{};  ///< of the plant, at its start
  std::vector<LinearForm<Number>> slopes{};  ///< x′ at its start
  std::vector<LinearForm<Number>> ends{};    ///< at its end, where the torque jumps; else none
  LinearForm<Number> torque{};
};

/// The numbers at a tick are the plant's, the controller's, the position last counted if the speed
/// is a difference of positions, that last read if the position controller reads at some ticks
/// alone, and the torques that wait, the newest first.
template <class Number>
struct SteppedDrive {
  /// Its slopes are the numbers at the next tick, or at the next that reads the position, with
  /// inputs that stand still. The gap is that which is read at the tick.
  LinearSystem<Number> step{};
  std::size_t last_counted = 0;
  std::vector<HeldPart<Number>> parts{};
};

enum class TorqueInput {
  requested,  ///< that of the controller: the loop
  open        ///< LinearInput::torque, which begins at the tick; the effort is what is requested
};

/// Each hold is divided into `parts` of equal length; they are those of the first tick.
/// Precondition: a sampled drive.
template <class Number>
SteppedDrive<Number> stepped_drive(const LinearDrive<Number>& drive, TorqueInput torque,
                                   int parts = 1);

}  // namespace gearlash
