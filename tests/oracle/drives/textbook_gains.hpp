// Gains of a cascade as a textbook's rule gives them.
#pragma once

#include "plain_drive.hpp"

namespace gearlash::oracle {

/// The drive with the gains of the symmetric optimum (Kessler, "Das symmetrische Optimum",
/// Regelungstechnik 6, 1958; Schröder and Böcker, "Elektrische Antriebe – Regelung von
/// Antriebssystemen", Springer 2021). The speed loop sees the inertia J of both shafts behind the
/// sum of small times T: the delay, half a period of the hold and half a period of the difference
/// that is the speed.
///   speed gain J/(2T), integral time 4T (also that of the anti-windup), and, for a speed loop like
///   1/(4T s + 1), the position gain 1/(4 · 4T) of critical damping.
/// Gap, friction, compliance and encoder do not enter. Precondition: a sampled cascade.
[[nodiscard]] PlainDrive with_textbook_gains(const PlainDrive& drive);

}  // namespace gearlash::oracle
