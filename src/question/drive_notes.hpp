// What a drive's file says that an answer takes in a way its reader should know, or leaves out.
#pragma once

#include <vector>

#include "gearlash/answer.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {

/// Codes: "assumed-encoder" (where it is taken to be), "counted-turns" (of moteus, whose ratio
/// multiplies that of the gearbox), "firmware" (the gains that its registers
/// mean), "no-load-current" (the dry friction that it gives), "efficiency" (left out), "gravity"
/// (its torque and stiffness where the reference ends).
std::vector<Note> notes_on(const SoundDrive& sound);

}  // namespace gearlash
