// The size of the limit cycle as the program of 1960 finds it (recommendation 1 of the thesis).
#pragma once

#include <cstddef>

#include "thesis/program_1960.hpp"

namespace gearlash::thesis {

/// Of the load, from one contact on the same face to the next; rad, and s for ω_n = 1.
struct SettledCycle {
  bool settled = false;    ///< false: still changing when the longest run was over
  bool hunts = false;      ///< false: the faces did not meet for 100 s
  bool diverged = false;   ///< the step is too long for this servo: the numbers grow without bound
  double amplitude = 0.0;  ///< half peak-to-peak, mean of the last cycles
  double smallest = 0.0;   ///< of those cycles: on a grid of 0.01 s none is like the next
  double largest = 0.0;
  double period = 0.0;     ///< mean of the same
  std::size_t cycles = 0;  ///< that were averaged
  double run_time = 0.0;   ///< s of the servo's time that were computed
};

/// Runs the program, in double precision, until the mean size of twenty cycles differs from that of
/// the twenty before by less than a thousandth, or the faces have not met for 100 s, or 20,000 s
/// are over, or the numbers exceed all bounds.
SettledCycle run_until_settled(const ProgramParameters& parameters, const Mending& mending = {});

/// The same by the emulated machine, in its own arithmetic; `instructions` counts what it executed.
struct MachineRun {
  SettledCycle cycle;
  std::size_t instructions = 0;
};
MachineRun run_machine_until_settled(const ProgramParameters& parameters);

}  // namespace gearlash::thesis
