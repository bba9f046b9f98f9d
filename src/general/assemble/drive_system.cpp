#include "general/assemble/drive_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "general/assemble/signal_generator.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::Direction;
using hybrid::Matrix;
using hybrid::Vector;

// ---- sums of affine forms -----------------------------------------------------------------------

AffineForm operator+(const AffineForm& a, const AffineForm& b) {
  return {a.normal + b.normal, a.offset + b.offset};
}
AffineForm operator-(const AffineForm& a, const AffineForm& b) {
  return {a.normal - b.normal, a.offset - b.offset};
}
AffineForm operator*(double factor, const AffineForm& form) {
  return {factor * form.normal, factor * form.offset};
}
AffineForm operator+(const AffineForm& form, double constant) {
  return {form.normal, form.offset + constant};
}
AffineForm operator-(const AffineForm& form, double constant) { return form + (-constant); }

// ---- what states mean ---------------------------------------------------------------------------

/// +1 on the forward face, −1 on the backward one, 0 apart.
double face_of(ContactState contact) {
  switch (contact) {
    case ContactState::forward:
    case ContactState::forward_limited:
    case ContactState::forward_letting_go:
      return 1.0;
    case ContactState::backward:
    case ContactState::backward_limited:
    case ContactState::backward_letting_go:
      return -1.0;
    case ContactState::apart:
      break;
  }
  return 0.0;
}

/// Which way a shaft moves; 0 where it sticks, or friction does not ask.
double way_of(FrictionState friction) {
  if (friction == FrictionState::forward) return 1.0;
  return friction == FrictionState::backward ? -1.0 : 0.0;
}

const char* text_of(ContactState contact) {
  constexpr std::array<const char*, 7> names = {"apart",
                                                "forward",
                                                "backward",
                                                "forward, damping limited",
                                                "backward, damping limited",
                                                "forward, letting go",
                                                "backward, letting go"};
  return names[static_cast<std::size_t>(contact)];
}

const char* text_of(FrictionState friction) {
  constexpr std::array<const char*, 4> names = {"", "moves forward", "moves backward", "sticks"};
  return names[static_cast<std::size_t>(friction)];
}

std::string text_of(const DriveMode& mode) {
  std::string text = text_of(mode.contact);
  if (mode.motor != FrictionState::viscous) text += std::string("; motor ") + text_of(mode.motor);
  if (mode.load != FrictionState::viscous) text += std::string("; load ") + text_of(mode.load);
  if (mode.torque == TorqueState::highest) text += "; torque at its highest";
  if (mode.torque == TorqueState::lowest) text += "; torque at its lowest";
  return text;
}

// ---- the builder --------------------------------------------------------------------------------

class Builder {
 public:
  explicit Builder(const Drive& drive)
      : drive_(drive),
        controller_(drive.sampling ? sampled_controller(drive.controller, *drive.sampling)
                                   : linear_controller(drive.controller)),
        rigid_(std::holds_alternative<RigidContact>(drive.contact)),
        reference_generator_(generator_of(drive.reference)),
        load_generator_(generator_of(drive.load_torque)) {
    name_numbers();
    list_modes();
  }

  DriveSystem build() {
    hybrid::HybridSystem& system = result_.system;
    add_clocks();
    for (const DriveMode& mode : result_.modes) {
      hybrid::Mode built;
      built.name = text_of(mode);
      built.flow = flow_of(mode);
      if (drive_.sampling) {
        add_sampling(mode, built);
      } else {
        add_torque_limit(mode, built);
        add_counting(mode, built);
      }
      if (is_engaged(mode)) {
        add_engaged(mode, built);
      } else {
        add_friction(mode, built, Side::motor);
        add_friction(mode, built, Side::load);
        add_contact(mode, built);
      }
      add_settings(mode, built);
      result_.motor_torque.push_back(motor_torque(mode));
      system.modes.push_back(std::move(built));
    }
    result_.start = start();
    result_.first_readings = first_readings();
    result_.reference = of(reference_generator_, reference_at_);
    result_.load_torque = load_torque();
    return std::move(result_);
  }

 private:
  enum class Side { motor, load };

  // ---- numbers ----------------------------------------------------------------------------------

  static constexpr Eigen::Index none = -1;

  /// Which number of the state is what.
  void name_numbers() {
    std::vector<std::string>& names = result_.system.state_names;
    names = {"motor position", "motor speed", "load position", "load speed"};
    for (std::size_t i = 0; i < controller_.order(); ++i) {
      names.push_back("controller " + std::to_string(i + 1));
    }
    const auto add = [&](const std::string& name) {
      names.push_back(name);
      return static_cast<Eigen::Index>(names.size()) - 1;
    };
    if (drive_.sampling) {
      held_ = add("torque held");
      if (drive_.sampling->delay > 0.0) worked_out_ = add("torque worked out");
      if (drive_.sampling->speed_by_differences) last_reading_ = add("last reading");
    } else if (drive_.sensing.resolution > 0.0) {
      reading_ = add("encoder");
    }
    const auto add_generator = [&](const Generator& generator, const char* name) {
      const auto at = static_cast<Eigen::Index>(names.size());
      for (Eigen::Index i = 0; i < generator.size(); ++i) {
        names.push_back(std::string(name) + (i == 0 ? "" : " " + std::to_string(i + 1)));
      }
      return at;
    };
    reference_at_ = add_generator(reference_generator_, "reference");
    load_at_ = add_generator(load_generator_, "load torque");
    size_ = result_.system.size();
  }

  Vector start() const {
    Vector numbers = Vector::Zero(size_);
    numbers.segment(reference_at_, reference_generator_.size()) = reference_generator_.start;
    numbers.segment(load_at_, load_generator_.size()) = load_generator_.start;
    return numbers;
  }

  /// As if the speeds had been the same before.
  hybrid::Reset first_readings() const {
    hybrid::Reset reset{Matrix::Identity(size_, size_), Vector::Zero(size_), {}};
    const Sensing& sensing = drive_.sensing;
    if (reading_ != none) {
      add_reading(reset, sensed_position(), sensing.resolution, Vector::Unit(size_, reading_));
    }
    if (last_reading_ != none) {
      const AffineForm earlier = counted_position() - drive_.sampling->period * sensed_speed();
      add_reading(reset, earlier, sensing.resolution_of_speed, Vector::Unit(size_, last_reading_));
    }
    return reset;
  }

  AffineForm of(const Generator& generator, Eigen::Index at) const {
    AffineForm form = constant(generator.offset);
    form.normal.segment(at, generator.size()) = generator.output;
    return form;
  }

  // ---- clocks -----------------------------------------------------------------------------------

  /// Signals change before the controller samples them.
  void add_clocks() {
    std::vector<hybrid::Clock>& clocks = result_.system.clocks;
    const auto add_signal = [&](const Generator& generator, Eigen::Index at, const char* name) {
      if (generator.times.empty()) return;
      hybrid::Clock clock;
      clock.name = name;
      clock.times = generator.times;
      for (const Vector& setting : generator.settings) {
        clock.additions.push_back(Vector::Zero(size_));
        clock.additions.back().segment(at, generator.size()) = setting;
      }
      settings_.push_back({clocks.size(), at, generator.size(), name});
      clocks.push_back(std::move(clock));
    };
    add_signal(reference_generator_, reference_at_, "reference");
    add_signal(load_generator_, load_at_, "load torque");
    if (!drive_.sampling) return;
    sample_clock_ = clocks.size();
    clocks.push_back({.name = "sample", .first = 0.0, .period = drive_.sampling->period});
    if (!gives_out_between_samples()) return;
    clocks.push_back(
        {.name = "output", .first = drive_.sampling->delay, .period = drive_.sampling->period});
  }

  bool gives_out_between_samples() const {
    const Sampling& sampling = *drive_.sampling;
    return sampling.delay > 0.0 && sampling.delay < sampling.period;
  }

  void add_settings(const DriveMode& mode, hybrid::Mode& built) const {
    for (const Setting& setting : settings_) {
      hybrid::TimedTransition timed;
      timed.name = setting.name;
      timed.clock = setting.clock;
      timed.reset.matrix = Matrix::Identity(size_, size_);
      timed.reset.matrix.block(setting.at, setting.at, setting.size, setting.size).setZero();
      timed.target = index_of(mode);
      built.timed.push_back(std::move(timed));
    }
  }

  // ---- a sampled controller ---------------------------------------------------------------------

  /// Adds a multiple of a reading to numbers of the state after a tick.
  void add_reading(hybrid::Reset& reset, const AffineForm& measured, double step,
                   const Vector& gain) const {
    if (step > 0.0) {
      reset.quantizers.push_back({measured, step, gain});
    } else {
      reset.matrix += gain * measured.normal.transpose();
      reset.offset += gain * measured.offset;
    }
  }

  void add_sampling(const DriveMode& mode, hybrid::Mode& built) const {
    const Sampling& sampling = *drive_.sampling;
    const Sensing& sensing = drive_.sensing;
    const auto order = static_cast<Eigen::Index>(controller_.order());
    hybrid::Reset reset{Matrix::Identity(size_, size_), Vector::Zero(size_), {}};
    const bool waits = sampling.delay > 0.0;
    const Eigen::Index result = waits ? worked_out_ : held_;
    const auto set = [&](Eigen::Index row, const AffineForm& form) {
      reset.matrix.row(row) = form.normal.transpose();
      reset.offset[row] = form.offset;
    };
    for (Eigen::Index i = 0; i < order; ++i) {
      const auto row = static_cast<std::size_t>(i);
      AffineForm next = of_controller(controller_.state_matrix[row]);
      if (!controller_.anti_windup.empty() && mode.torque != TorqueState::linear) {
        next = next + controller_.anti_windup[row] * (motor_torque(mode) - number(held_));
      }
      set(controller_states + i, next);
    }
    set(result, of_controller(controller_.output));
    if (last_reading_ != none) set(last_reading_, constant(0.0));
    if (waits && !gives_out_between_samples()) set(held_, number(worked_out_));
    // What the inputs r, y and v add.
    const auto gain_of = [&](std::size_t input) {
      Vector gain = Vector::Zero(size_);
      for (Eigen::Index i = 0; i < order; ++i) {
        gain[controller_states + i] = controller_.input_matrix[static_cast<std::size_t>(i)][input];
      }
      gain[result] = controller_.direct[input];
      return gain;
    };
    add_reading(reset, of(reference_generator_, reference_at_), 0.0, gain_of(0));
    add_reading(reset, sensed_position(), sensing.resolution, gain_of(1));
    const Vector speed_gain = gain_of(2);
    if (last_reading_ == none) {
      add_reading(reset, sensed_speed(), 0.0, speed_gain);
    } else {
      const Vector kept = Vector::Unit(size_, last_reading_);
      add_reading(reset, counted_position(), sensing.resolution_of_speed,
                  1.0 / sampling.period * speed_gain + kept);
      add_reading(reset, number(last_reading_), 0.0, -1.0 / sampling.period * speed_gain);
    }
    const bool gives_out = !gives_out_between_samples();
    built.timed.push_back(timed("sample", sample_clock_, std::move(reset), mode, gives_out));
    if (gives_out) return;
    hybrid::Reset output{Matrix::Identity(size_, size_), Vector::Zero(size_), {}};
    output.matrix.row(held_) = Vector::Unit(size_, worked_out_).transpose();
    built.timed.push_back(timed("output", sample_clock_ + 1, std::move(output), mode, true));
  }

  hybrid::TimedTransition timed(const char* name, std::size_t clock, hybrid::Reset reset,
                                DriveMode mode, bool gives_out) const {
    hybrid::TimedTransition result;
    result.name = name;
    result.clock = clock;
    result.reset = std::move(reset);
    if (gives_out && std::isfinite(drive_.torque_limit)) {
      for (const double way : {1.0, -1.0}) {
        DriveMode limited = mode;
        limited.torque = way > 0.0 ? TorqueState::highest : TorqueState::lowest;
        result.alternatives.push_back(
            {{way * number(held_) - drive_.torque_limit}, index_of(limited)});
      }
      mode.torque = TorqueState::linear;
    }
    result.target = index_of(mode);
    return result;
  }

  // ---- an encoder under a continuous controller -------------------------------------------------

  void add_counting(const DriveMode& mode, hybrid::Mode& built) const {
    if (reading_ == none) return;
    const double step = drive_.sensing.resolution;
    for (const double way : {1.0, -1.0}) {
      hybrid::Transition counts = transition(
          way > 0.0 ? "encoder counts up" : "encoder counts down",
          sensed_position() - number(reading_) - 0.5 * way * step, rising_on(way), index_of(mode));
      counts.reset.offset = way * step * Vector::Unit(size_, reading_);
      built.transitions.push_back(std::move(counts));
    }
  }

  // ---- modes ------------------------------------------------------------------------------------

  bool is_engaged(const DriveMode& mode) const {
    return rigid_ && mode.contact != ContactState::apart;
  }

  std::vector<ContactState> contacts() const {
    using enum ContactState;
    if (rigid_) return {apart, forward, backward};
    const auto& compliant = std::get<CompliantContact>(drive_.contact);
    std::vector<ContactState> all = {apart, forward, backward};
    if (compliant.damping > 0.0) {
      all.insert(all.end(), {forward_letting_go, backward_letting_go});
      if (compliant.law == ContactDamping::limited) {
        all.insert(all.end(), {forward_limited, backward_limited});
      }
    }
    return all;
  }

  static std::vector<FrictionState> frictions(const Shaft& shaft) {
    using enum FrictionState;
    if (!shaft.friction.is_dry()) return {viscous};
    return {forward, backward, sticking};
  }

  void list_modes() {
    std::vector<TorqueState> torques = {TorqueState::linear};
    if (std::isfinite(drive_.torque_limit)) {
      torques.insert(torques.end(), {TorqueState::highest, TorqueState::lowest});
    }
    for (const ContactState contact : contacts()) {
      for (const FrictionState motor : frictions(drive_.motor)) {
        for (const FrictionState load : frictions(drive_.load)) {
          const bool as_one =
              motor == load || motor == FrictionState::viscous || load == FrictionState::viscous;
          for (const TorqueState torque : torques) {
            const DriveMode mode{contact, motor, load, torque};
            if (as_one || !is_engaged(mode)) result_.modes.push_back(mode);
          }
        }
      }
    }
  }

  std::size_t index_of(const DriveMode& mode) const { return result_.index_of(mode); }

  // ---- forms ------------------------------------------------------------------------------------

  AffineForm number(Eigen::Index index) const { return {Vector::Unit(size_, index), 0.0}; }
  AffineForm constant(double value) const { return {Vector::Zero(size_), value}; }
  AffineForm gap() const { return number(motor_position) - number(load_position); }
  AffineForm gap_speed() const { return number(motor_speed) - number(load_speed); }

  AffineForm sensed(double load_share, Eigen::Index motor, Eigen::Index load) const {
    return load_share * number(load) + (1.0 - load_share) * number(motor);
  }

  AffineForm sensed_position() const {
    return sensed(drive_.sensing.load_share_of_position, motor_position, load_position);
  }
  /// Whose differences are the speed.
  AffineForm counted_position() const {
    return sensed(drive_.sensing.load_share_of_speed, motor_position, load_position);
  }
  AffineForm sensed_speed() const {
    return sensed(drive_.sensing.load_share_of_speed, motor_speed, load_speed);
  }

  /// Σ factors (r, y, v), of a continuous controller.
  AffineForm of_inputs(const std::vector<double>& factors) const {
    return factors[0] * of(reference_generator_, reference_at_) +
           factors[1] * (reading_ == none ? sensed_position() : number(reading_)) +
           factors[2] * sensed_speed();
  }

  AffineForm of_controller(const std::vector<double>& factors) const {
    AffineForm sum = constant(0.0);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      sum.normal[controller_states + static_cast<Eigen::Index>(i)] = factors[i];
    }
    return sum;
  }

  AffineForm asked_torque() const {
    if (drive_.sampling) return number(held_);
    return of_controller(controller_.output) + of_inputs(controller_.direct);
  }

  AffineForm motor_torque(const DriveMode& mode) const {
    if (mode.torque == TorqueState::highest) return constant(drive_.torque_limit);
    if (mode.torque == TorqueState::lowest) return constant(-drive_.torque_limit);
    return asked_torque();
  }

  /// Anti-windup, of one of the controller's states.
  AffineForm withdrawal(const DriveMode& mode, std::size_t state) const {
    if (controller_.anti_windup.empty() || mode.torque == TorqueState::linear) return constant(0.0);
    return controller_.anti_windup[state] * (motor_torque(mode) - asked_torque());
  }

  AffineForm load_torque() const { return of(load_generator_, load_at_); }

  const CompliantContact& compliant() const { return std::get<CompliantContact>(drive_.contact); }

  AffineForm spring_torque(double face) const {
    return compliant().stiffness * (gap() - 0.5 * face * drive_.backlash);
  }
  AffineForm damping_torque() const { return compliant().damping * gap_speed(); }

  /// On the load; of faces that give, or apart.
  AffineForm mesh_torque(const DriveMode& mode) const {
    const double face = face_of(mode.contact);
    switch (mode.contact) {
      case ContactState::forward:
      case ContactState::backward:
        return spring_torque(face) + damping_torque();
      case ContactState::forward_limited:
      case ContactState::backward_limited:
        return 2.0 * spring_torque(face);
      default:
        return constant(0.0);
    }
  }

  /// Without friction.
  AffineForm applied_torque(const DriveMode& mode, Side side) const {
    return side == Side::motor ? motor_torque(mode) - mesh_torque(mode)
                               : mesh_torque(mode) + load_torque();
  }

  AffineForm friction_torque(const Shaft& shaft, FrictionState state, Eigen::Index speed) const {
    return shaft.friction.viscous * number(speed) + way_of(state) * shaft.friction.coulomb;
  }

  /// Of both shafts as one.
  AffineForm engaged_acceleration(const DriveMode& mode) const {
    if (sticks_as_one(mode)) return constant(0.0);
    const double inertia = drive_.motor.inertia + drive_.load.inertia;
    const AffineForm torque = motor_torque(mode) + load_torque() -
                              friction_torque(drive_.motor, mode.motor, motor_speed) -
                              friction_torque(drive_.load, mode.load, load_speed);
    return 1.0 / inertia * torque;
  }

  static bool sticks_as_one(const DriveMode& mode) {
    return mode.motor == FrictionState::sticking || mode.load == FrictionState::sticking;
  }

  AffineForm acceleration(const DriveMode& mode, Side side) const {
    if (is_engaged(mode)) return engaged_acceleration(mode);
    const bool is_motor = side == Side::motor;
    const Shaft& shaft = is_motor ? drive_.motor : drive_.load;
    const FrictionState state = is_motor ? mode.motor : mode.load;
    if (state == FrictionState::sticking) return constant(0.0);
    const Eigen::Index speed = is_motor ? motor_speed : load_speed;
    return 1.0 / shaft.inertia *
           (applied_torque(mode, side) - friction_torque(shaft, state, speed));
  }

  hybrid::AffineFlow flow_of(const DriveMode& mode) const {
    hybrid::AffineFlow flow{Matrix::Zero(size_, size_), Vector::Zero(size_)};
    const auto set = [&](Eigen::Index row, const AffineForm& form) {
      flow.matrix.row(row) = form.normal.transpose();
      flow.offset[row] = form.offset;
    };
    set(motor_position, number(motor_speed));
    set(motor_speed, acceleration(mode, Side::motor));
    set(load_position, number(load_speed));
    set(load_speed, acceleration(mode, Side::load));
    flow.matrix.block(reference_at_, reference_at_, reference_generator_.size(),
                      reference_generator_.size()) = reference_generator_.flow;
    flow.matrix.block(load_at_, load_at_, load_generator_.size(), load_generator_.size()) =
        load_generator_.flow;
    for (std::size_t i = 0; !drive_.sampling && i < controller_.order(); ++i) {
      set(controller_states + static_cast<Eigen::Index>(i),
          of_controller(controller_.state_matrix[i]) + of_inputs(controller_.input_matrix[i]) +
              withdrawal(mode, i));
    }
    return flow;
  }

  // ---- transitions ------------------------------------------------------------------------------

  static hybrid::Transition transition(const char* name, const AffineForm& guard,
                                       Direction direction, std::size_t target) {
    hybrid::Transition result;
    result.name = name;
    result.guard = guard;
    result.direction = direction;
    result.target = target;
    return result;
  }

  static Direction falling_on(double way) {
    return way > 0.0 ? Direction::falling : Direction::rising;
  }
  static Direction rising_on(double way) {
    return way > 0.0 ? Direction::rising : Direction::falling;
  }

  void add_torque_limit(const DriveMode& mode, hybrid::Mode& built) const {
    if (!std::isfinite(drive_.torque_limit)) return;
    const AffineForm asked = asked_torque();
    const auto to = [&](TorqueState torque) {
      DriveMode target = mode;
      target.torque = torque;
      return index_of(target);
    };
    const double limit = drive_.torque_limit;
    if (mode.torque == TorqueState::linear) {
      built.transitions.push_back(transition("torque reaches its highest", asked - limit,
                                             Direction::rising, to(TorqueState::highest)));
      built.transitions.push_back(transition("torque reaches its lowest", asked + limit,
                                             Direction::falling, to(TorqueState::lowest)));
      return;
    }
    const double way = mode.torque == TorqueState::highest ? 1.0 : -1.0;
    built.transitions.push_back(transition("torque leaves its limit", asked - way * limit,
                                           falling_on(way), to(TorqueState::linear)));
  }

  /// A speed put to exactly 0.
  hybrid::Reset stopped(std::initializer_list<Eigen::Index> speeds) const {
    hybrid::Reset reset;
    reset.matrix = Matrix::Identity(size_, size_);
    for (const Eigen::Index speed : speeds) reset.matrix(speed, speed) = 0.0;
    return reset;
  }

  void add_friction(const DriveMode& mode, hybrid::Mode& built, Side side) const {
    const bool is_motor = side == Side::motor;
    const Shaft& shaft = is_motor ? drive_.motor : drive_.load;
    const FrictionState state = is_motor ? mode.motor : mode.load;
    if (state == FrictionState::viscous) return;
    const auto to = [&](FrictionState next) {
      DriveMode target = mode;
      (is_motor ? target.motor : target.load) = next;
      return index_of(target);
    };
    const AffineForm applied = applied_torque(mode, side);
    const double breakaway = shaft.friction.breakaway;
    if (state == FrictionState::sticking) {
      built.transitions.push_back(
          transition(is_motor ? "motor breaks away forward" : "load breaks away forward",
                     applied - breakaway, Direction::rising, to(FrictionState::forward)));
      built.transitions.push_back(
          transition(is_motor ? "motor breaks away backward" : "load breaks away backward",
                     applied + breakaway, Direction::falling, to(FrictionState::backward)));
      return;
    }
    const double way = way_of(state);
    const Eigen::Index speed = is_motor ? motor_speed : load_speed;
    hybrid::Transition stops = transition(is_motor ? "motor stops" : "load stops", number(speed),
                                          falling_on(way), to(FrictionState::sticking));
    stops.reset = stopped({speed});
    const FrictionState back = way > 0.0 ? FrictionState::backward : FrictionState::forward;
    stops.alternatives = {{{-way * applied - breakaway}, to(back)}};
    built.transitions.push_back(std::move(stops));
  }

  void add_contact(const DriveMode& mode, hybrid::Mode& built) const {
    if (rigid_) {
      add_impact(mode, built, 1.0);
      add_impact(mode, built, -1.0);
    } else {
      add_compliance(mode, built);
    }
  }

  // ---- faces that give --------------------------------------------------------------------------

  void add_compliance(const DriveMode& mode, hybrid::Mode& built) const {
    const bool damped = compliant().damping > 0.0;
    const bool limited = damped && compliant().law == ContactDamping::limited;
    const auto to = [&](ContactState contact) {
      DriveMode target = mode;
      target.contact = contact;
      return index_of(target);
    };
    const auto state_on = [](double face, ContactState forward, ContactState backward) {
      return face > 0.0 ? forward : backward;
    };
    const auto full = [&](double face) {
      return state_on(face, ContactState::forward, ContactState::backward);
    };
    const auto limited_on = [&](double face) {
      return state_on(face, ContactState::forward_limited, ContactState::backward_limited);
    };
    const auto letting_go = [&](double face) {
      return state_on(face, ContactState::forward_letting_go, ContactState::backward_letting_go);
    };
    const auto add = [&](const char* name, const AffineForm& guard, Direction direction,
                         ContactState target) {
      built.transitions.push_back(transition(name, guard, direction, to(target)));
    };
    const auto pressed = [&](double face) { return gap() - 0.5 * face * drive_.backlash; };
    const double face = face_of(mode.contact);
    if (face == 0.0) {
      for (const double met : {1.0, -1.0}) {
        add(met > 0.0 ? "faces meet forward" : "faces meet backward", pressed(met), rising_on(met),
            limited ? limited_on(met) : full(met));
      }
      return;
    }
    const AffineForm torque = spring_torque(face) + damping_torque();
    const AffineForm damping_excess = damping_torque() - spring_torque(face);
    if (mode.contact == full(face)) {
      if (!damped) {
        add("faces part", pressed(face), falling_on(face), ContactState::apart);
        return;
      }
      add("faces let go", torque, falling_on(face), letting_go(face));
      if (limited) {
        add("damping is limited", damping_excess, rising_on(face), limited_on(face));
      }
    } else if (mode.contact == limited_on(face)) {
      add("damping is no more limited", damping_excess, falling_on(face), full(face));
      add("faces part", pressed(face), falling_on(face), ContactState::apart);
    } else {
      add("faces part", pressed(face), falling_on(face), ContactState::apart);
      add("faces press again", torque, rising_on(face), full(face));
    }
  }

  // ---- rigid faces ------------------------------------------------------------------------------

  /// Momentum is kept, relative speed turned into −e of itself.
  hybrid::Reset impact(double restitution) const {
    const double sum = drive_.motor.inertia + drive_.load.inertia;
    const double motor = drive_.motor.inertia / sum;
    const double load = drive_.load.inertia / sum;
    hybrid::Reset reset;
    reset.matrix = Matrix::Identity(size_, size_);
    reset.matrix(motor_speed, motor_speed) = motor - restitution * load;
    reset.matrix(motor_speed, load_speed) = load * (1.0 + restitution);
    reset.matrix(load_speed, motor_speed) = motor * (1.0 + restitution);
    reset.matrix(load_speed, load_speed) = load - restitution * motor;
    return reset;
  }

  /// The ways in which dry shafts may move after an impact, with what tells them.
  std::vector<hybrid::Alternative> ways_after(const DriveMode& target) const {
    std::vector<hybrid::Alternative> alternatives;
    const auto ways = [](FrictionState state) {
      return state == FrictionState::viscous ? std::vector<double>{0.0}
                                             : std::vector<double>{1.0, -1.0, 0.0};
    };
    const auto moving = [](FrictionState state, double way) {
      if (state == FrictionState::viscous) return state;
      if (way == 0.0) return FrictionState::sticking;
      return way > 0.0 ? FrictionState::forward : FrictionState::backward;
    };
    for (const double motor : ways(target.motor)) {
      for (const double load : ways(target.load)) {
        DriveMode mode = target;
        mode.motor = moving(target.motor, motor);
        mode.load = moving(target.load, load);
        if (std::find(result_.modes.begin(), result_.modes.end(), mode) == result_.modes.end()) {
          continue;
        }
        hybrid::Alternative alternative;
        if (motor != 0.0) alternative.positive.push_back(motor * number(motor_speed));
        if (load != 0.0) alternative.positive.push_back(load * number(load_speed));
        alternative.target = index_of(mode);
        alternatives.push_back(std::move(alternative));
      }
    }
    std::stable_sort(alternatives.begin(), alternatives.end(), [](const auto& a, const auto& b) {
      return a.positive.size() > b.positive.size();
    });
    return alternatives;
  }

  void add_impact(const DriveMode& mode, hybrid::Mode& built, double face) const {
    const double restitution = std::get<RigidContact>(drive_.contact).restitution;
    DriveMode apart = mode;
    DriveMode engaged = mode;
    engaged.contact = face > 0.0 ? ContactState::forward : ContactState::backward;
    const bool plastic = restitution == 0.0;
    hybrid::Transition meets = transition(face > 0.0 ? "impact forward" : "impact backward",
                                          gap() - 0.5 * face * drive_.backlash, rising_on(face), 0);
    meets.reset = impact(restitution);
    // Where all that is dry has come to rest no alternative asks anything.
    meets.alternatives = ways_after(plastic ? engaged : apart);
    meets.target = meets.alternatives.back().target;
    meets.alternatives.pop_back();
    if (!plastic) {
      hybrid::Settling settling;
      settling.reset = impact(0.0);
      settling.alternatives = ways_after(engaged);
      settling.target = settling.alternatives.back().target;
      settling.alternatives.pop_back();
      meets.settling = std::move(settling);
    }
    built.transitions.push_back(std::move(meets));
  }

  /// Where engaged faces part: one speed, and the gap as wide as it is.
  hybrid::Reset parting(double face) const {
    hybrid::Reset reset;
    reset.matrix = Matrix::Identity(size_, size_);
    reset.matrix.row(motor_position) = Vector::Unit(size_, load_position).transpose();
    reset.matrix.row(motor_speed) = Vector::Unit(size_, load_speed).transpose();
    reset.offset = Vector::Zero(size_);
    reset.offset[motor_position] = 0.5 * face * drive_.backlash;
    return reset;
  }

  void add_engaged(const DriveMode& mode, hybrid::Mode& built) const {
    if (sticks_as_one(mode)) {
      add_engaged_breakaway(mode, built);
      return;
    }
    const double face = face_of(mode.contact);
    DriveMode apart = mode;
    apart.contact = ContactState::apart;
    const AffineForm mesh = drive_.load.inertia * engaged_acceleration(mode) +
                            friction_torque(drive_.load, mode.load, load_speed) - load_torque();
    hybrid::Transition parts = transition("faces part", mesh, falling_on(face), index_of(apart));
    parts.reset = parting(face);
    built.transitions.push_back(std::move(parts));
    const double way = way_of(mode.motor) != 0.0 ? way_of(mode.motor) : way_of(mode.load);
    if (way == 0.0) return;
    hybrid::Transition stops = transition("both stop", number(load_speed), falling_on(way),
                                          index_of(moving_as_one(mode, 0.0)));
    stops.reset = stopped({motor_speed, load_speed});
    const AffineForm applied = motor_torque(mode) + load_torque();
    stops.alternatives = {
        {{-way * applied - both_breakaway()}, index_of(moving_as_one(mode, -way))}};
    built.transitions.push_back(std::move(stops));
  }

  double both_breakaway() const {
    return drive_.motor.friction.breakaway + drive_.load.friction.breakaway;
  }

  static DriveMode moving_as_one(const DriveMode& mode, double way) {
    const FrictionState state = way > 0.0   ? FrictionState::forward
                                : way < 0.0 ? FrictionState::backward
                                            : FrictionState::sticking;
    DriveMode moving = mode;
    if (moving.motor != FrictionState::viscous) moving.motor = state;
    if (moving.load != FrictionState::viscous) moving.load = state;
    return moving;
  }

  /// Both at rest, faces together: both move where all friction is overcome; one alone, away from
  /// the other, where its own is.
  void add_engaged_breakaway(const DriveMode& mode, hybrid::Mode& built) const {
    const AffineForm applied = motor_torque(mode) + load_torque();
    for (const double way : {1.0, -1.0}) {
      built.transitions.push_back(transition(
          way > 0.0 ? "both break away forward" : "both break away backward",
          applied - way * both_breakaway(), rising_on(way), index_of(moving_as_one(mode, way))));
    }
    const double face = face_of(mode.contact);
    const auto add_alone = [&](Side side, double away) {
      const bool is_motor = side == Side::motor;
      DriveMode alone = mode;
      alone.contact = ContactState::apart;
      FrictionState& state = is_motor ? alone.motor : alone.load;
      if (state != FrictionState::viscous) {
        state = away > 0.0 ? FrictionState::forward : FrictionState::backward;
      }
      const Shaft& shaft = is_motor ? drive_.motor : drive_.load;
      const AffineForm torque = is_motor ? motor_torque(mode) : load_torque();
      hybrid::Transition breaks =
          transition(is_motor ? "motor breaks away alone" : "load breaks away alone",
                     torque - away * shaft.friction.breakaway, rising_on(away), index_of(alone));
      breaks.reset = parting(face);
      built.transitions.push_back(std::move(breaks));
    };
    add_alone(Side::motor, -face);
    add_alone(Side::load, face);
  }

  /// Numbers that a clock sets.
  struct Setting {
    std::size_t clock;
    Eigen::Index at;
    Eigen::Index size;
    std::string name;
  };

  const Drive& drive_;
  LinearController controller_;
  bool rigid_;
  Generator reference_generator_;
  Generator load_generator_;
  Eigen::Index size_ = 0;
  Eigen::Index reference_at_ = 0;
  Eigen::Index load_at_ = 0;
  Eigen::Index held_ = none;          ///< torque, of a sampled controller
  Eigen::Index worked_out_ = none;    ///< torque, to be given out after the delay
  Eigen::Index last_reading_ = none;  ///< of the position whose differences are the speed
  Eigen::Index reading_ = none;       ///< of an encoder under a continuous controller
  std::size_t sample_clock_ = 0;
  std::vector<Setting> settings_;
  DriveSystem result_;
};

}  // namespace

std::size_t DriveSystem::index_of(const DriveMode& mode) const {
  return static_cast<std::size_t>(std::find(modes.begin(), modes.end(), mode) - modes.begin());
}

ShaftStates shafts_of(const hybrid::State& state) {
  const Vector& numbers = state.numbers;
  return {numbers[motor_position], numbers[motor_speed], numbers[load_position],
          numbers[load_speed]};
}

DriveSystem drive_system(const Drive& drive) {
  require_none(validate(drive));
  return Builder(drive).build();
}

hybrid::State drive_start(const Drive& drive, const DriveSystem& system,
                          const ShaftStates& shafts) {
  const bool rigid = std::holds_alternative<RigidContact>(drive.contact);
  const double gap = shafts.motor_position - shafts.load_position;
  const double half = 0.5 * drive.backlash;
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  const double unknown =
      rounding * (std::abs(shafts.motor_position) + std::abs(shafts.load_position));
  RangeCheck check;
  if (rigid && std::abs(gap) > half + unknown) {
    check.refuse("motor_position - load_position", exact_text(gap),
                 "must be within half the backlash, " + exact_text(half) + " rad");
  }
  require_none(check.violations());
  DriveMode mode;
  const bool is_closed = std::abs(gap) >= half - (rigid ? unknown : 0.0);
  if (is_closed && (!rigid || shafts.motor_speed == shafts.load_speed)) {
    mode.contact = gap > 0.0 ? ContactState::forward : ContactState::backward;
  }
  const auto friction = [](const Shaft& shaft, double speed) {
    if (!shaft.friction.is_dry()) return FrictionState::viscous;
    if (speed == 0.0) return FrictionState::sticking;
    return speed > 0.0 ? FrictionState::forward : FrictionState::backward;
  };
  mode.motor = friction(drive.motor, shafts.motor_speed);
  mode.load = friction(drive.load, shafts.load_speed);
  Vector numbers = system.start;
  numbers[motor_position] = shafts.motor_position;
  numbers[motor_speed] = shafts.motor_speed;
  numbers[load_position] = shafts.load_position;
  numbers[load_speed] = shafts.load_speed;
  return {system.index_of(mode), system.first_readings.after(numbers)};
}

}  // namespace gearlash::drive
