#include <cmath>

#include "base/extent.hpp"
#include "base/lists.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/hybrid.hpp"
#include "hybrid/periodic_orbit.hpp"
#include "hybrid/turns.hpp"
#include "numeric/elimination.hpp"

namespace gearlash::hybrid {
namespace {

Row row_of(const Vector& vector) { return {vector.begin(), vector.end()}; }

bool is_ragged(const std::vector<Row>& rows) {
  return any_of(rows, [&](const Row& row) { return row.size() != rows.front().size(); });
}

AffineForm form_of(const Form& form) { return {vector_of(form.normal), form.offset}; }

}  // namespace

struct System::Definition {
  HybridSystem system{};
  std::vector<Fault> faults{};
  std::optional<std::size_t> last_event{};  ///< the mode that has it as its last transition

  AffineMode* known(const Mode& mode, const std::string& event) {
    if (mode.index < system.modes.size()) return &system.modes[mode.index];
    faults.push_back({"event \"" + event + "\".mode", std::to_string(mode.index),
                      "must be a mode of this system"});
    return nullptr;
  }

  Matrix matrix(const std::string& where, const std::vector<Row>& rows) {
    if (!is_ragged(rows)) return matrix_of(rows, rows.empty() ? 0 : rows.front().size());
    faults.push_back({where + ".matrix", "", "must have rows of one length"});
    return Matrix::Identity(system.size(), system.size());
  }

  AffineReset reset(const std::string& event, const Reset& reset) {
    return {matrix("event \"" + event + "\".reset", reset.matrix), vector_of(reset.offset), {}};
  }
};

System::System(std::vector<std::string> state_names) : definition_(std::make_shared<Definition>()) {
  definition_->system.state_names = std::move(state_names);
}

System::Definition& System::own() {
  if (definition_.use_count() > 1) definition_ = std::make_shared<Definition>(*definition_);
  return *definition_;
}

Mode System::mode(std::string name, const std::vector<Row>& matrix, Row offset) {
  Definition& definition = own();
  if (offset.empty()) offset.resize(definition.system.state_names.size());
  const std::string where = "mode \"" + name + "\".flow";
  definition.system.modes.push_back(
      {std::move(name), {definition.matrix(where, matrix), vector_of(offset)}, {}, {}});
  return {definition.system.modes.size() - 1};
}

Timer System::timer(std::string name, double period, double first) {
  std::vector<Clock>& clocks = own().system.clocks;
  clocks.push_back({std::move(name), first, period, {}, {}});
  return {clocks.size() - 1};
}

System& System::on(Mode from, std::string event, const Form& guard, Mode to, Direction direction,
                   const Reset& reset) {
  Definition& definition = own();
  definition.last_event.reset();
  if (AffineMode* const mode = definition.known(from, event)) {
    AffineReset onto = definition.reset(event, reset);
    mode->transitions.push_back(
        {std::move(event), form_of(guard), direction, std::move(onto), to.index, {}, {}});
    definition.last_event = from.index;
  }
  return *this;
}

System& System::on_tick(Mode from, std::string event, Timer timer, Mode to, const Reset& reset) {
  Definition& definition = own();
  definition.last_event.reset();
  if (AffineMode* const mode = definition.known(from, event)) {
    AffineReset onto = definition.reset(event, reset);
    mode->timed.push_back({std::move(event), timer.index, std::move(onto), to.index, {}});
  }
  return *this;
}

System& System::settling(Mode to, const Reset& onto) {
  Definition& definition = own();
  if (definition.last_event) {
    Transition& transition = definition.system.modes[*definition.last_event].transitions.back();
    transition.settling = {to.index, definition.reset(transition.name, onto), {}};
  } else {
    definition.faults.push_back({"settling", "", "must follow an event with a guard"});
  }
  return *this;
}

const HybridSystem& assembled(const System& system) {
  require_none(system.definition_->faults);
  return system.definition_->system;
}

namespace {

State start_of(Mode mode, const Row& numbers) { return {mode.index, vector_of(numbers)}; }

}  // namespace

Motion::Motion(const System& system, Trajectory trajectory)
    : trajectory_(std::make_shared<const Trajectory>(std::move(trajectory))) {
  const HybridSystem& engine = assembled(system);
  for (const hybrid::Event& event : trajectory_->events()) {
    events_.push_back({event.time,
                       event.name(engine),
                       {event.mode},
                       {event.mode_after},
                       row_of(event.before),
                       row_of(event.after),
                       event.kind == EventKind::settling});
  }
}

double Motion::end_time() const { return trajectory_->end_time(); }

End Motion::end() const {
  switch (trajectory_->stop_reason()) {
    case StopReason::reached_end:
      return End::time;
    case StopReason::event_limit:
    case StopReason::step_limit:  // is not set here
    case StopReason::stopped:     // likewise
      return End::event_limit;
    case StopReason::zeno:
      return End::accumulation;
    case StopReason::chattering:
      return End::chattering;
    case StopReason::diverged:
      break;
  }
  return End::divergence;
}

Mode Motion::mode_at(double time) const { return {trajectory_->at(time).mode}; }

Row Motion::at(double time) const { return row_of(trajectory_->at(time).numbers); }

Motion simulate(const System& system, Mode start, const Row& state, double until) {
  return {system, simulate(assembled(system), start_of(start, state), {.until = until})};
}

std::optional<Orbit> find_orbit(const System& system, Mode start, const Row& state, double until) {
  const PreparedSystem prepared(assembled(system));
  const Trajectory motion = simulate(prepared, start_of(start, state), {.until = until});
  const std::optional<PeriodicOrbit> found = closing_orbit(prepared, motion);
  if (!found) return std::nullopt;
  return Orbit{{found->start.mode}, row_of(found->start.numbers), found->start_time, found->period,
               found->residual,     found->is_stable(),           found->multipliers};
}

Bounds extent(const System& system, const Orbit& orbit, const Form& form) {
  const HybridSystem& engine = assembled(system);
  const AffineForm affine = form_of(form);
  if (affine.normal.size() != engine.size()) {
    throw InvalidInput({{"form.normal", std::to_string(form.normal.size()) + " numbers",
                         "must be " + std::to_string(engine.size()) + " numbers"}});
  }
  const PreparedSystem turns(with_turns(
      engine, [affine](std::size_t, const AffineMode& mode) { return rate_of(affine, mode.flow); },
      OtherEvents::left_out));
  const Trajectory turn =
      simulate(engine, start_of(orbit.mode, orbit.start),
               {.from = orbit.start_time, .until = orbit.start_time + orbit.period});
  Extent extent;
  for_each_turn(
      turn, turns, [](std::size_t) { return true; },
      [&](double, std::size_t, const Vector& numbers) { extent.include(affine.at(numbers)); });
  return extent;
}

}  // namespace gearlash::hybrid
