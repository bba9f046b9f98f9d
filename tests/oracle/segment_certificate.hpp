// Proof, apart from the library's own, that a simulated trajectory missed no event and invented
// none: every segment is covered by cells in which a bound on the second derivative excludes a
// zero, and every event is checked against the law that it stands for.
#pragma once

#include <cstdint>
#include <string>

#include "random_servo.hpp"

namespace gearlash::oracle {

struct CertificateCounts {
  std::uint64_t servos = 0;
  std::uint64_t segments = 0;
  std::uint64_t events = 0;
  std::uint64_t cells = 0;        ///< intervals on which a zero was excluded
  std::uint64_t settlings = 0;    ///< chains of bounces replaced by their limit
  std::uint64_t undecidable = 0;  ///< closer to grazing than rounding can tell
  std::uint64_t faults = 0;
  double closest_grazing = 0.0;   ///< largest distance, of the scale, that stayed undecidable
  double worst_event_time = 0.0;  ///< worst |Δt| of an event, of the period 2π
  std::string first_fault;        ///< empty when there is none
  std::uint64_t first_fault_servo = 0;

  void add(const CertificateCounts& other);
};

/// Method. Between events the state is evaluated in long double by divided differences of exp
/// (gap) and by a scaled and squared matrix exponential (engaged), from the state that the library
/// reports at the segment's start. With f the distance to a face, or the mesh torque, and M ≥ |f̈|
/// on a cell of width h, obtained from the raw equations:
///   f ≥ min(f(ends)) − M h²/8              inside,
///   f > 0 for 0 < t < 2 ḟ(0)/M              next to a zero that begins the segment,
///   f > 0 for 0 < T − t < 2 |ḟ(T)|/M        next to a zero that ends it.
/// A gap that opens without relative speed starts with a cell in which the sign of d̈ is proved.
/// Events: an impact must lie on the face it names and be approached, keep momentum, and reverse
/// the relative speed times e; a separation must be a falling zero of the mesh torque; the mode
/// that follows must be the one that the contact rule demands.
CertificateCounts certify(const RandomCase& drawn, const Trajectory& trajectory);

/// The same of the trajectory that the library makes of the case.
CertificateCounts certify(const RandomCase& drawn, double until, std::size_t event_limit);

}  // namespace gearlash::oracle
