// How much the faces press each other on the average, however a drive moves.
#pragma once

#include <optional>
#include <string>

#include "model/enclosed_drive.hpp"

namespace gearlash {

/// N m at the load's shaft: the mean of the mesh torque's size over any motion, in the end, is at
/// most this (docs/explanation/absence-by-energy.md, "The mesh torque"). Proved of every drive
/// that is enclosed, for motion that reaches neither torque limit in the end. Rigid faces, a
/// continuous linear controller, constant reference and load torque. Empty for other drives, with
/// dry friction or an encoder, and where no bound is found.
std::optional<double> highest_mean_mesh_torque(const EnclosedDrive& drive);

}  // namespace gearlash
