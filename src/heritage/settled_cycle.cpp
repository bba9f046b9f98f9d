#include "gearlash/heritage/settled_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gearlash/heritage/thesis_machine.hpp"

namespace gearlash::heritage {
namespace {

constexpr std::size_t window = 20;  // cycles

struct Cycle {
  double end;
  double size;
};

/// Gathers the cycles of a running program: each ends at every second contact.
class Cycles {
 public:
  /// After each step: where the load is, and whether there has been a contact.
  void take(const PrintedLine& now, bool contact) {
    time_ = now.time;
    low_ = std::min(low_, now.load_position);
    high_ = std::max(high_, now.load_position);
    if (!contact) return;
    last_contact_ = now.time;
    if (++contacts_ % 2 != 0) return;
    if (contacts_ > 2) cycles_.push_back({now.time, 0.5 * (high_ - low_)});
    low_ = high_ = now.load_position;
  }

  const std::vector<Cycle>& all() const { return cycles_; }
  double last_contact() const { return last_contact_; }
  double time() const { return time_; }

 private:
  std::vector<Cycle> cycles_;
  std::size_t contacts_ = 0;
  double last_contact_ = 0.0;
  double time_ = 0.0;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

double mean_size(const std::vector<Cycle>& cycles, std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from; i < from + window; ++i) sum += cycles[i].size;
  return sum / static_cast<double>(window);
}

bool has_settled(const std::vector<Cycle>& cycles) {
  constexpr double tolerance = 1e-3;
  if (cycles.size() < 2 * window + 1) return false;
  const double before = mean_size(cycles, cycles.size() - 2 * window);
  const double now = mean_size(cycles, cycles.size() - window);
  return std::abs(now - before) < tolerance * now;
}

void describe(const std::vector<Cycle>& cycles, SettledCycle& result) {
  const std::size_t from = cycles.size() - window;
  const auto [smallest, largest] =
      std::minmax_element(cycles.begin() + static_cast<std::ptrdiff_t>(from), cycles.end(),
                          [](const Cycle& a, const Cycle& b) { return a.size < b.size; });
  result.size = mean_size(cycles, from);
  result.smallest = smallest->size;
  result.largest = largest->size;
  result.period = (cycles.back().end - cycles[from - 1].end) / static_cast<double>(window);
  result.cycles = window;
}

template <class Step>
SettledCycle settle(const Step& step) {
  constexpr double longest_run = 20'000.0;
  constexpr double longest_quiet = 100.0;
  Cycles cycles;
  SettledCycle result;
  while (result.run_time < longest_run) {
    const std::size_t count = cycles.all().size();
    step(cycles);
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

SettledCycle run_until_settled(const ProgramParameters& parameters) {
  Program1960<double> program(parameters);
  return settle([&](Cycles& cycles) {
    bool contact = false;
    program.step([&](const PrintedLine& line) { contact = contact || line.at_contact; });
    cycles.take(program.line(), contact);
  });
}

MachineRun run_machine_until_settled(const ProgramParameters& parameters) {
  ThesisMachine machine;
  machine.set(parameters);
  MachineRun run;
  run.cycle = settle([&](Cycles& cycles) {
    const bool contact = machine.step();
    cycles.take(machine.state(), contact);
  });
  run.instructions = machine.machine().registers().executed;
  return run;
}

}  // namespace gearlash::heritage
