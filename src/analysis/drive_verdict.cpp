#include "analysis/drive_verdict.hpp"

namespace gearlash::drive {

DriveVerdict verdict_of(const AttractorSearch& search) {
  const bool rests = search.count(MotionEnd::rest) > 0;
  const bool cycles = search.count(MotionEnd::cycle) > 0;
  const bool swings = cycles || search.count(MotionEnd::irregular) > 0;
  const bool diverges = search.count(MotionEnd::diverges) > 0;
  if (swings && rests) return DriveVerdict::hunts_if_disturbed;
  if (cycles) return DriveVerdict::hunts;
  if (swings) return DriveVerdict::hunts_irregularly;
  if (diverges) return rests ? DriveVerdict::runs_away_if_disturbed : DriveVerdict::runs_away;
  // Starts of which nothing is known could hunt.
  const bool all_rest = rests && search.count(MotionEnd::undecided) == 0 && search.is_complete;
  return all_rest ? DriveVerdict::comes_to_rest : DriveVerdict::undecided;
}

const FoundCycle* largest_stable(const AttractorSearch& search) {
  const FoundCycle* largest = nullptr;
  for (const FoundCycle& cycle : search.cycles) {
    if (cycle.stability == Stability::unstable) continue;
    if (largest == nullptr || cycle.size > largest->size) largest = &cycle;
  }
  return largest;
}

bool is_driven(const ReducedDrive& drive) {
  return std::holds_alternative<Sine>(settled(drive.reference)) ||
         std::holds_alternative<Sine>(settled(drive.load_torque));
}

const char* name_of(DriveVerdict verdict) {
  switch (verdict) {
    case DriveVerdict::comes_to_rest:
      return "comes to rest";
    case DriveVerdict::hunts:
      return "hunts";
    case DriveVerdict::hunts_irregularly:
      return "hunts irregularly";
    case DriveVerdict::hunts_if_disturbed:
      return "hunts if disturbed";
    case DriveVerdict::runs_away:
      return "runs away";
    case DriveVerdict::runs_away_if_disturbed:
      return "runs away if disturbed";
    case DriveVerdict::undecided:
      return "undecided";
  }
  return "";
}

const char* name_of(DriveVerdict verdict, const ReducedDrive& drive) {
  const bool hunts = verdict == DriveVerdict::hunts || verdict == DriveVerdict::hunts_irregularly ||
                     verdict == DriveVerdict::hunts_if_disturbed;
  return hunts && is_driven(drive) ? "swings as it is driven" : name_of(verdict);
}

}  // namespace gearlash::drive
