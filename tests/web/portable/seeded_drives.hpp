// Seeded drives without a closed form.
#pragma once

#include <cstdint>

#include "gearlash/drive.hpp"

namespace gearlash::portable {

/// A torque-controlled motor under PD or PID, on the load's or the motor's sensor. Both shafts have
/// Coulomb friction, the load in part a higher breakaway torque. The faces are plastic, bouncing or
/// compliant.
[[nodiscard]] Drive continuous_drive(std::uint64_t seed);

/// The same with a controller that samples every 2 … 20 ms, and a tachometer.
[[nodiscard]] Drive sampled_drive(std::uint64_t seed);

}  // namespace gearlash::portable
