// The limit cycle's amplitude by the program of 1960 (recommendation 1 of the thesis).
#pragma once

#include <cstddef>

#include "gearlash/progress.hpp"
#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

/// The load's motion from one contact on a face to the next on the same face; rad, and s for ω_n =
/// 1.
struct SettledCycle {
  bool settled = false;    ///< false: still changing at the end of the longest run
  bool hunts = false;      ///< false: no contact for 100 s
  bool diverged = false;   ///< the step is too long for this servo: numbers grow without bound
  double amplitude = 0.0;  ///< half peak-to-peak, mean of the last cycles
  double smallest = 0.0;   ///< of those cycles, which differ on a grid of 0.01 s
  double largest = 0.0;
  double period = 0.0;     ///< mean of those cycles
  std::size_t cycles = 0;  ///< number of averaged cycles
  double run_time = 0.0;   ///< computed time of the servo, s
};

/// Runs the program in double precision. The run ends when the mean amplitude of twenty cycles
/// differs from that of the twenty before by less than a thousandth, after 100 s without contact,
/// after 20,000 s, when the numbers exceed all bounds, or when Progress stops it.
SettledCycle run_until_settled(const ProgramParameters& parameters, const Mending& mending = {},
                               Progress& progress = no_progress());

/// The same run on the emulated machine, in its own arithmetic; `instructions` counts those
/// executed.
struct MachineRun {
  SettledCycle cycle;
  std::size_t instructions = 0;
};
MachineRun run_machine_until_settled(const ProgramParameters& parameters,
                                     Progress& progress = no_progress());

}  // namespace gearlash::thesis
