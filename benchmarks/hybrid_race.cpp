#include "hybrid_race.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "closed_form/limit_cycle.hpp"
#include "cvode_rival.hpp"
#include "drive_rival.hpp"
#include "general/assemble/drive_system.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "hybrid/servo_system.hpp"
#include "model/controller_forms.hpp"
#include "odeint_rival.hpp"

namespace gearlash::benchmarks {
namespace {

/// Motor's and load's positions and speeds.
using End = std::array<double, 4>;

struct Line {
  std::string title;
  std::string name;
  double difference;  ///< from our end
};

struct Table {
  std::string title;
  std::string note;
  std::vector<Line> lines;  ///< ours first
  End ours{};
};

double difference(const End& a, const End& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Checks where `work` ends, and registers it.
template <class Work>
void enter(Table& table, const std::string& name, const Work& work) {
  const End end = work();
  if (table.lines.empty()) table.ours = end;
  constexpr double permitted = 1e-6;
  const double off = difference(end, table.ours);
  if (!(off <= permitted)) throw std::runtime_error(name + " ends elsewhere: " + table.title);
  const std::string title = table.title + "/" + name;
  benchmark::RegisterBenchmark(title.c_str(), [work](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(work());
  })->Unit(benchmark::kMicrosecond);
  table.lines.push_back({title, name, off});
}

End end_of(const hybrid::Trajectory& motion) {
  End end;
  std::copy_n(motion.end().numbers.begin(), end.size(), end.begin());
  return end;
}

// ---- a period of the thesis's servo -------------------------------------------------------------

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// A period of its cycle from a separation on, to just before the next one.
template <class Rival>
End period_of(Rival& rival, const LimitCycle& cycle) {
  double time = 0.0;
  double face = 1.0;
  EngagedState state = {cycle.start.load_position, cycle.start.load_speed};
  const Coefficients coefficients(sample);
  for (int half = 0; half < 2; ++half) {
    follow_half_cycle(rival, coefficients, time, state, face);
  }
  const double gap = 0.5 * sample.backlash;
  return {state[0] + gap, state[1], state[0], state[1]};
}

Table enter_servo() {
  Table table{"A period of the thesis's servo", "four events", {}};
  const LimitCycle cycle = analyse_limit_cycles(sample).cycles.front();
  const hybrid::HybridSystem system = servo_system(sample);
  const hybrid::PreparedSystem prepared(system);
  const ServoState& s = cycle.start;
  const hybrid::State start{
      separated, hybrid::Vector{{s.motor_position, s.motor_speed, s.load_position, s.load_speed}}};
  const hybrid::SimulationOptions options{.until = cycle.period};
  enter(table, "Gearlash, hybrid::simulate()",
        [=] { return end_of(simulate(prepared, start, options)); });
  enter(table, "the same, system not prepared",
        [=] { return end_of(simulate(system, start, options)); });
  const auto rival = [&](const char* name, auto integrator) {
    enter(table, name, [integrator, cycle] { return period_of(*integrator, cycle); });
  };
  rival("Boost.odeint, dopri5 dense output", std::make_shared<OdeintRival>(sample));
  rival("SUNDIALS CVODE, Adams", std::make_shared<CvodeRival>(sample, CvodeMethod::adams));
  rival("SUNDIALS CVODE, BDF dense", std::make_shared<CvodeRival>(sample, CvodeMethod::bdf));
  return table;
}

// ---- a second of a sampled drive ----------------------------------------------------------------

drive::ReducedDrive sampled_drive() {
  drive::ReducedDrive drive;
  drive.motor = {2e-3, {.viscous = 0.01, .coulomb = 0.02, .breakaway = 0.02}};
  drive.load = {4e-3, {.viscous = 0.01, .coulomb = 0.02, .breakaway = 0.02}};
  drive.backlash = 0.02;
  drive.contact =
      drive::CompliantContact{.stiffness = 200.0, .damping = 0.2, .law = ContactDamping::full};
  drive.controller = drive::forms::linear(PID{.terms = PIDTerms::PID,
                                              .proportional = 2.0,
                                              .integral = 5.0,
                                              .derivative = 0.1,
                                              .derivative_of_speed = true},
                                          AsRead(), 1.0);
  drive.sampling = Sampling{.period = 1e-3, .speed_by_differences = false};
  drive.reference = 0.5;
  return drive;
}

Table enter_drive() {
  const drive::ReducedDrive drive = sampled_drive();
  const drive::DriveSystem built = drive_system(drive);
  const hybrid::PreparedSystem prepared(built.system);
  const hybrid::State start = drive_start(drive, built, {});
  const hybrid::SimulationOptions options{.until = 1.0};
  const hybrid::Trajectory motion = simulate(prepared, start, options);
  const auto ticks = std::count_if(
      motion.events().begin(), motion.events().end(),
      [](const hybrid::Event& event) { return event.kind == hybrid::EventKind::timed; });
  const auto others = static_cast<std::ptrdiff_t>(motion.events().size()) - ticks;
  Table table{"A second of a sampled PID drive with friction and compliance",
              std::to_string(ticks) + " ticks, " + std::to_string(others) + " other events",
              {}};
  enter(table, "Gearlash, hybrid::simulate()",
        [=] { return end_of(simulate(prepared, start, options)); });
  enter(table, "the same, system not prepared",
        [=, system = built.system] { return end_of(simulate(system, start, options)); });
  const auto rival = [&](const char* name, CvodeMethod method) {
    enter(table, name, [integrator = std::make_shared<CvodeDriveRival>(drive, method)] {
      return integrator->run(1.0);
    });
  };
  rival("SUNDIALS CVODE, Adams", CvodeMethod::adams);
  rival("SUNDIALS CVODE, BDF dense", CvodeMethod::bdf);
  return table;
}

void print(const Table& table, const FastestTimes& times) {
  const double ours = times.of(table.lines.front().title);
  if (std::isnan(ours)) return;
  std::printf(
      "\n**%s** (%s)\n\n| | µs | times the first | difference at the end |\n|---|--:|--:|--:|\n",
      table.title.c_str(), table.note.c_str());
  for (const Line& line : table.lines) {
    const double time = times.of(line.title);
    if (std::isnan(time)) continue;
    std::printf("| %s | %.4g | %.3g | %.1e |\n", line.name.c_str(), 1e6 * time, time / ours,
                line.difference);
  }
}

}  // namespace

ReportPart enter_hybrid_race() {
  const std::vector<Table> tables = {enter_servo(), enter_drive()};
  return [tables](const FastestTimes& times) {
    for (const Table& table : tables) print(table, times);
  };
}

}  // namespace gearlash::benchmarks
