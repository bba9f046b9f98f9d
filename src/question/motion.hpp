// The source of a Motion, for either engine.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "gearlash/motion.hpp"
#include "general/assemble/drive_system.hpp"
#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash {

class Motion::Source {
 public:
  virtual ~Source() = default;

  virtual MotionSample at(double time) const = 0;
  virtual std::optional<EnergyBooks> energy() const { return std::nullopt; }

  std::vector<MotionEvent> events;
  std::vector<MotionTouch> touches;
  double asked_until = 0.0;  ///< s, the last sample of a motion that reached its end
  double end_time = 0.0;
  MotionStop stop = MotionStop::reached_end;
  std::string stop_text;
  Engine engine{};
};

/// A motion keeps its steps, each with all numbers of the drive. So many take half a gigabyte.
inline constexpr std::size_t most_steps_of_a_motion = 4'000'000;

/// A motion computed by the general engine. It may begin at any time; the result's times are
/// relative to that. Forms of `system` whose size differs from its state's are taken as 0.
Motion motion_of(drive::DriveSystem system, hybrid::Trajectory trajectory,
                 double until = std::numeric_limits<double>::infinity());

}  // namespace gearlash
