// How many operations of each kind the batch kernel does for a servo.
#pragma once

#include <cstddef>
#include <span>

#include "model/normalized_servo.hpp"
#include "operations.hpp"

namespace gearlash::benchmarks {

/// Means over the servos, with so many lanes in step (1, 4, 8 or 16): what a servo needs alone, or
/// beside neighbours, whose forms and iterations are then worked out for it as well.
ByOperation<double> operations_of_kernel(std::span<const NormalizedServo> servos,
                                         std::size_t lanes);

}  // namespace gearlash::benchmarks
