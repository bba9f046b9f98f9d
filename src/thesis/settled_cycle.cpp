#include "thesis/settled_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/lists.hpp"
#include "thesis/thesis_machine.hpp"

namespace gearlash::thesis {
namespace {

constexpr std::size_t window = 20;  // cycles

struct Cycle {
  double end;
  double amplitude;
};

/// Collects the cycles of a running program. A cycle ends at every second contact.
class Cycles {
 public:
  /// Takes a step's result and whether a contact occurred in it.
  void take(const PrintedLine& now, bool contact) {
    time_ = now.time;
    motor_position_ = now.motor_position;
    load_position_ = now.load_position;
    low_ = std::min(low_, now.load_position);
    high_ = std::max(high_, now.load_position);
    if (!contact) return;
    last_contact_ = now.time;
    if (++contacts_ % 2 != 0) return;
    if (contacts_ > 2) cycles_.push_back({now.time, 0.5 * (high_ - low_)});
    low_ = high_ = now.load_position;
  }

  const std::vector<Cycle>& all() const { return cycles_; }
  /// A servo at rest, hunting or coming to rest stays within a few backlashes and steps.
  bool out_of_bounds() const {
    constexpr double bound = 1e12;
    return !(std::abs(motor_position_) < bound) || !(std::abs(load_position_) < bound);
  }
  double last_contact() const { return last_contact_; }
  double time() const { return time_; }

 private:
  std::vector<Cycle> cycles_;
  std::size_t contacts_ = 0;
  double last_contact_ = 0.0;
  double time_ = 0.0;
  double motor_position_ = 0.0;
  double load_position_ = 0.0;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

double mean_amplitude(const std::vector<Cycle>& cycles, std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from; i < from + window; ++i) sum += cycles[i].amplitude;
  return sum / static_cast<double>(window);
}

bool has_settled(const std::vector<Cycle>& cycles) {
  constexpr double tolerance = 1e-3;
  if (cycles.size() < 2 * window + 1) return false;
  const double before = mean_amplitude(cycles, cycles.size() - 2 * window);
  const double now = mean_amplitude(cycles, cycles.size() - window);
  return std::abs(now - before) < tolerance * now;
}

void describe(const std::vector<Cycle>& cycles, SettledCycle& result) {
  const std::size_t from = cycles.size() - window;
  const auto [smallest, largest] = std::minmax_element(
      cycles.begin() + static_cast<std::ptrdiff_t>(from), cycles.end(), by(&Cycle::amplitude));
  result.amplitude = mean_amplitude(cycles, from);
  result.smallest = smallest->amplitude;
  result.largest = largest->amplitude;
  result.period = (cycles.back().end - cycles[from - 1].end) / static_cast<double>(window);
  result.cycles = window;
}

/// step(cycles) advances by one step. It returns false if the arithmetic has overflowed.
template <class Step>
SettledCycle settle(const Step& step, Progress& progress) {
  constexpr double longest_run = 20'000.0;
  constexpr double longest_quiet = 100.0;
  Cycles cycles;
  SettledCycle result;
  while (result.run_time < longest_run && progress.go_on(result.run_time / longest_run)) {
    const std::size_t count = cycles.all().size();
    result.diverged = !step(cycles) || cycles.out_of_bounds();
    if (result.diverged) return result;
    result.run_time = cycles.time();
    if (result.run_time - cycles.last_contact() > longest_quiet) {
      result.settled = true;
      return result;
    }
    if (cycles.all().size() == count || !has_settled(cycles.all())) continue;
    result.settled = result.hunts = true;
    describe(cycles.all(), result);
    return result;
  }
  result.hunts = true;
  if (cycles.all().size() > window) describe(cycles.all(), result);
  return result;
}

}  // namespace

SettledCycle run_until_settled(const ProgramParameters& parameters, const Mending& mending,
                               Progress& progress) {
  Program1960<double> program(parameters, mending);
  const auto step = [&](Cycles& cycles) {
    bool contact = false;
    program.step([&](const PrintedLine& line) { contact = contact || line.at_contact; });
    cycles.take(program.line(), contact);
    return true;
  };
  return settle(step, progress);
}

MachineRun run_machine_until_settled(const ProgramParameters& parameters, Progress& progress) {
  ThesisMachine machine;
  machine.set(parameters);
  MachineRun run;
  const auto step = [&](Cycles& cycles) {
    try {
      const bool contact = machine.step();
      cycles.take(machine.state(), contact);
      return true;
    } catch (const std::overflow_error&) {  // the machine's exponent fault
      return false;
    }
  };
  run.cycle = settle(step, progress);
  run.instructions = machine.machine().registers().executed;
  return run;
}

}  // namespace gearlash::thesis
