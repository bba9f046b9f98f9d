// Finds periodic motions of hybrid systems by shooting, with their Floquet multipliers.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "hybrid/hybrid_trajectory.hpp"

namespace gearlash::hybrid {

struct PeriodicOrbit {
  State start;              ///< between the event that closes the period and the next one
  double start_time = 0.0;  ///< for a system with clocks
  double period = 0.0;
  std::vector<Event> events;  ///< of one period, from the start on; the last one closes it
  /// Floquet's, by falling modulus: the factors by which disturbances are multiplied over a period.
  /// For an autonomous system without the one of a shift in time, and without those of numbers that
  /// nothing acts on (references, counts).
  std::vector<std::complex<double>> multipliers;
  /// The largest mismatch of a phase's end and the next one's start, as a share of the state.
  double residual = 0.0;

  bool is_stable() const;  ///< all multipliers within the unit circle
};

struct ShootingOptions {
  std::size_t most_events = 200;  ///< in a period
  std::size_t phases = 4;         ///< at most this many phases are shot at once
  double nearness =
      1e-2;             ///< two passings this near each other, as a share of the state, may be one
  int most_steps = 30;  ///< of Newton's method
  int most_tries = 30;  ///< recurrences of the last event that are tried, the nearest first
};

/// The orbit that the end of a trajectory is near. Newton's method closes the recurrences of the
/// last event, with the same events between, the nearest to the end first:
///   Fᵢ(xᵢ) = xᵢ₊₁,  i = 1 … phases, the last on the first.
/// Fᵢ is the motion over some of the events, with saltation, from one plane across it to the next,
/// midway between events where there is most time. Numbers that nothing acts on (references,
/// and counts, which events change by constants) stay as the trajectory has them; where references
/// move, the period is theirs. With
/// periodic clocks it is a multiple of theirs. A motion that repeats within the period found is
/// reported once. Empty if nothing recurs or Newton's method does not converge.
std::optional<PeriodicOrbit> closing_orbit(const PreparedSystem& system, const Trajectory& motion,
                                           const ShootingOptions& options = {});

/// The orbit near another one's start, with the same number of events, for a system that has
/// changed slightly.
std::optional<PeriodicOrbit> neighbouring_orbit(const PreparedSystem& system,
                                                const PeriodicOrbit& near,
                                                const ShootingOptions& options = {});

/// The same without periodic clocks, for an orbit that is known in its own system: Newton's method
/// starts with all phases on it, and so finds unstable orbits too.
std::optional<PeriodicOrbit> neighbouring_orbit(const PreparedSystem& system,
                                                const PeriodicOrbit& near,
                                                const PreparedSystem& system_of_near,
                                                const ShootingOptions& options = {});

}  // namespace gearlash::hybrid
