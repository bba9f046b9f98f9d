#include "contestants.hpp"

#include <cmath>

#include "closed_form/growth_at_rest.hpp"
#include "closed_form/lanes/cycle_batch.hpp"
#include "closed_form/limit_cycle.hpp"
#include "closed_form/phase.hpp"
#include "closed_form/trajectory.hpp"
#include "closed_form/unit_half_cycle.hpp"
#include "cvode_rival.hpp"
#include "odeint_rival.hpp"
#include "servo_lists.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::benchmarks {
namespace {

/// What one problem asks, made ready.
using SingleTask = std::function<RivalCycle()>;

Contestant one_by_one(const std::string& name, bool yardstick,
                      const std::function<SingleTask(const Problem&)>& prepare) {
  return {name, yardstick, [prepare](const std::vector<Problem>& problems) -> Task {
            std::vector<SingleTask> tasks;
            for (const Problem& problem : problems) tasks.push_back(prepare(problem));
            return [tasks](std::vector<RivalCycle>& answers) {
              for (std::size_t i = 0; i < tasks.size(); ++i) answers[i] = tasks[i]();
            };
          }};
}

struct RivalStart {
  EngagedState state;
  bool parted;
};

/// Cycles with bounces start after an impact; the state at which the faces part forward is found
/// once, outside all measurement.
ServoState separation_on_cycle(const Problem& problem) {
  if (problem.servo.restitution == 0.0) return problem.cycle.start;
  const Trajectory trajectory = simulate(problem.servo, problem.cycle.start,
                                         {.until = 1.5 * problem.cycle.period, .reference = 0.0});
  for (const Event& event : trajectory.events()) {
    if (event.kind == EventKind::separation && event.face == Face::forward) return event.after;
  }
  return problem.cycle.start;
}

RivalStart start_of(const Problem& problem, Start start) {
  constexpr double step = 1.0;  // of the reference, rad
  constexpr double nearness = 1.01;
  if (start == Start::from_rest) return {{-step, 0.0}, false};
  const ServoState on_cycle = separation_on_cycle(problem);
  return {{nearness * on_cycle.load_position, nearness * on_cycle.load_speed}, true};
}

/// Solvers live as long as the task does, and are used again in every call.
template <class Rival, class... Arguments>
Contestant cycle_rival(const std::string& name, Start start, Arguments... arguments) {
  return one_by_one(name, false, [=](const Problem& problem) -> SingleTask {
    auto rival = std::make_shared<Rival>(problem.servo, arguments...);
    const RivalStart begin = start_of(problem, start);
    return [rival, begin, servo = problem.servo] {
      return find_cycle(*rival, servo, begin.state, 1.0, begin.parted);
    };
  });
}

template <class Rival, class... Arguments>
Contestant half_cycle_rival(const std::string& name, Arguments... arguments) {
  return one_by_one(name, false, [=](const Problem& problem) -> SingleTask {
    auto rival = std::make_shared<Rival>(problem.servo, arguments...);
    const ServoState begin = separation_on_cycle(problem);
    const Coefficients coefficients(problem.servo);
    return [rival, begin, coefficients] {
      double time = 0.0;
      double face = 1.0;
      EngagedState state = {begin.load_position, begin.load_speed};
      const double amplitude = follow_half_cycle(*rival, coefficients, time, state, face);
      return RivalCycle{amplitude, 2.0 * time, 1, true};
    };
  });
}

/// All problems in one call.
Contestant side_by_side(VectorUnit unit, bool yardstick) {
  const std::string name = std::string("Gearlash, find_limit_cycles(), ") + name_of(unit);
  return {name, yardstick, [unit](const std::vector<Problem>& problems) -> Task {
            std::vector<NormalizedServo> servos;
            for (const Problem& problem : problems) servos.push_back(problem.servo);
            return [=, table = table_of(servos.size())](std::vector<RivalCycle>& answers) mutable {
              find_limit_cycles(servos, columns_of(table), unit);
              for (std::size_t i = 0; i < servos.size(); ++i) {
                answers[i] = {table[Quantity::amplitude][i], table[Quantity::period][i], 0,
                              table.verdict(i) == Verdict::hunts};
              }
            };
          }};
}

SingleTask prepare_analysis(const Problem& problem) {
  return [servo = problem.servo] {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    const LimitCycle& cycle = analysis.cycles.front();
    return RivalCycle{cycle.amplitude, cycle.period, 0, true};
  };
}

/// The layer below: the scalar equation alone, which gives the period; nothing else is worked out.
SingleTask prepare_scalar_equation(const Problem& problem) {
  return [servo = problem.servo, amplitude = problem.cycle.amplitude] {
    const ServoDynamics dynamics = servo_dynamics(servo);
    const auto half = balanced_half_cycle(dynamics, growth_at_rest(dynamics));
    return RivalCycle{amplitude, 2.0 * (half->flight_time + half->engaged_time), 0, true};
  };
}

/// The public simulator: the whole trajectory with its events, from a separation to just after the
/// next one.
SingleTask prepare_simulation(const Problem& problem) {
  const ServoState begin = separation_on_cycle(problem);
  const double until = 0.5 * problem.cycle.period * (1.0 + 1e-9);
  return [servo = problem.servo, begin, until, amplitude = problem.cycle.amplitude] {
    const Trajectory trajectory = simulate(servo, begin, {.until = until, .reference = 0.0});
    return RivalCycle{amplitude, 2.0 * trajectory.events().back().time, 1, true};
  };
}

/// The layer below: phase after phase until the next separation, nothing recorded.
SingleTask prepare_phases(const Problem& problem) {
  constexpr double horizon = 100.0;  // far beyond any half cycle
  const ServoState begin = separation_on_cycle(problem);
  return [servo = problem.servo, begin, amplitude = problem.cycle.amplitude] {
    const ServoDynamics dynamics = servo_dynamics(servo);
    Phase phase = parted_phase(dynamics, 1.0, begin.load_position, begin.load_speed);
    double time = 0.0;
    while (true) {
      const PhaseEnd end = end_of_phase(dynamics, phase, horizon);
      if (!end.has_event) return RivalCycle{};
      time += end.duration;
      if (end.kind == EventKind::separation) return RivalCycle{amplitude, 2.0 * time, 1, true};
      phase = end.next;
    }
  };
}

SingleTask prepare_program_of_1960(const Problem& problem) {
  return [parameters = thesis::program_parameters(problem.servo)] {
    const thesis::SettledCycle cycle = thesis::run_until_settled(parameters);
    return RivalCycle{cycle.amplitude, cycle.period, 2 * cycle.cycles,
                      cycle.settled && cycle.hunts};
  };
}

std::vector<Contestant> integrators(Start start) {
  return {cycle_rival<OdeintRival>("Boost.odeint, dopri5 dense output", start),
          cycle_rival<CvodeRival>("SUNDIALS CVODE, Adams", start, CvodeMethod::adams),
          cycle_rival<CvodeRival>("SUNDIALS CVODE, BDF dense", start, CvodeMethod::bdf)};
}

}  // namespace

std::vector<Contestant> settling_contestants() {
  std::vector<Contestant> contestants = integrators(Start::from_rest);
  contestants.push_back(one_by_one("Program of 1960 in C++", false, prepare_program_of_1960));
  return contestants;
}

std::vector<Contestant> limit_cycle_contestants(Start start, Contact contact) {
  std::vector<Contestant> contestants;
  if (contact == Contact::plastic) {
    contestants.push_back(side_by_side(widest_vector_unit(), true));
    for (const VectorUnit unit : available_vector_units()) {
      if (unit != widest_vector_unit()) contestants.push_back(side_by_side(unit, false));
    }
  }
  contestants.push_back(one_by_one("Gearlash, analyse_limit_cycles()", true, prepare_analysis));
  if (contact == Contact::plastic) {
    contestants.push_back(
        one_by_one("Gearlash, balanced_half_cycle()", false, prepare_scalar_equation));
  }
  for (const Contestant& rival : integrators(start)) contestants.push_back(rival);
  return contestants;
}

std::vector<Contestant> half_cycle_contestants() {
  return {one_by_one("Gearlash, simulate()", true, prepare_simulation),
          one_by_one("Gearlash, end_of_phase()", false, prepare_phases),
          half_cycle_rival<OdeintRival>("Boost.odeint, dopri5 dense output"),
          half_cycle_rival<CvodeRival>("SUNDIALS CVODE, Adams", CvodeMethod::adams),
          half_cycle_rival<CvodeRival>("SUNDIALS CVODE, BDF dense", CvodeMethod::bdf)};
}

}  // namespace gearlash::benchmarks
