// A proof by energy that a drive cannot hunt, whatever its contact.
#pragma once

#include "model/enclosed_drive.hpp"

namespace gearlash {

/// Whether it is proved that every motion of the drive comes to rest, the speeds of both shafts
/// tending to 0: seen from its contact, and from its dry frictions if it has any, the rest of the
/// drive only ever takes energy. It holds for
/// rigid faces of any restitution and for compliant ones, damped or not
/// (docs/explanation/absence-by-energy.md). Sufficient, not necessary. False for a
/// sampled controller, an encoder, a torque limit or a signal that moves, of which nothing is
/// proved here.
bool is_absent_by_energy(const EnclosedDrive& drive);

}  // namespace gearlash
