// A readable port of the program of Table I (1960), which computed the thesis's charts.
//
// Five properties determine its numbers. Each is marked in the code and has its address in Table I:
//   1. Runge–Kutta–Gill with h = 0.01. Its first stage uses the derivative that the previous
//      evaluation left. At t = 0 that is zero, not 1 (20026, UDOT, is assembled as zero).
//   2. In combined motion the load is set equal to the motor at every step, its stored derivative
//      included, and integrated alone for one step, to test whether it would run ahead (20001,
//      20063 RESET, 20061 TEST1).
//   3. In the gap the motor's step holds the load's position at the step before (20054 DERM reads
//      THETAL, which LOAD2 at 20015 updates only afterwards).
//   4. Contact is detected only at the end of a step, on the far face only (20073 TEST2). Then the
//      motor's position jumps to the load's (20150), after its stored derivative has been formed
//      with the old position (20145).
//   5. Every eighth step is printed, and every contact (20130 COUNT, "TEN" is octal; 20153).
// `Number` is the arithmetic: double or the machine's own (Number1604).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>

#include "model/normalized_servo.hpp"

namespace gearlash::thesis {

/// The parameters at 20156 … 20166, for ω_n = 1 and a step of 1 rad.
struct ProgramParameters {
  double friction = 0.4;        ///< B, twice the damping coefficient
  double load_rate = 0.125;     ///< D = F_L/J_L
  double motor_inertia = 0.2;   ///< E, and G
  double motor_friction = 0.3;  ///< F
  double load_inertia = 0.8;    ///< H
  double backlash = 0.3;        ///< between the load and the motor, one way

  bool operator==(const ProgramParameters&) const = default;
};

/// The parameters of the listing and of Table II.
inline constexpr ProgramParameters listed_parameters{};

/// Scales the servo as the thesis does, J_M + J_L = 1 and F_M + F_L = B. Throws InvalidInput unless
/// both inertias are positive (the program divides by E, its parameters by H) and contact is
/// plastic.
ProgramParameters program_parameters(const NormalizedServo& servo);

/// Corrections to the program that show the effect of each property. The original has none.
struct Mending {
  bool fresh_first_stage = false;        ///< 1: derivatives computed at the start of a step
  bool load_derivative_its_own = false;  ///< 2: after RESET, of the load alone
  bool shafts_together = false;          ///< 3: motor and load in one step in the gap
  bool contact_interpolated = false;     ///< 4: back along the step to the contact
  bool new_position_at_contact = false;  ///< 4: in the motor's derivative
  bool motor_position_in_gap = false;    ///< θ_M in the motor's equation, as in section 2

  bool operator==(const Mending&) const = default;
};

/// One line of the printout.
struct PrintedLine {
  double time = 0.0;
  double motor_speed = 0.0;
  double motor_position = 0.0;
  double load_speed = 0.0;
  double load_position = 0.0;
  bool at_contact = false;
};

template <class Number>
class Program1960 {
 public:
  explicit Program1960(const ProgramParameters& parameters, const Mending& mending = {})
      : mending_(mending),
        friction_(parameters.friction),
        load_rate_(parameters.load_rate),
        motor_inertia_(parameters.motor_inertia),
        motor_friction_(parameters.motor_friction),
        load_inertia_(parameters.load_inertia),
        backlash_(parameters.backlash) {}

  /// One pass of the loop: a step of 0.01 of motor and load, the tests, and `print(line)` for each
  /// printed line (none, the eighth step, the contact, or both).
  template <class Print>
  void step(const Print& print) {
    combined_ ? step_combined(print) : step_apart(print);
  }

  bool combined() const { return combined_; }
  PrintedLine line(bool at_contact = false) const {
    return {double(time_),
            double(motor_.speed.value),
            double(motor_.position.value),
            double(load_.speed.value),
            double(load_.position.value),
            at_contact};
  }

 private:
  /// An entry of the tables at 20023 and 20040: derivative, value and Gill's correction of its
  /// rounding, e.g. UDOT, U and QU.
  struct Variable {
    Number derivative{0.0};
    Number value{0.0};
    Number correction{0.0};
  };
  struct Shaft {
    Variable speed;
    Variable position;
  };

  /// RUNGE: four stages, each with the current derivatives (property 1).
  template <class Derivatives>
  void gill(std::initializer_list<Shaft*> shafts, const Derivatives& derivatives) {
    static const Number step{0.01};
    if (mending_.fresh_first_stage) derivatives();
    for (int stage = 0; stage < 4; ++stage) {
      for (Shaft* shaft : shafts) {
        for (Variable* variable : {&shaft->speed, &shaft->position}) {
          advance(*variable, step * variable->derivative, stage);
        }
      }
      derivatives();
    }
  }

  static void advance(Variable& variable, const Number& change, int stage) {
    static const Number half{0.5};
    static const Number two{2.0};
    static const Number three{3.0};
    static const Number sixth{1.0 / 6.0};
    static const std::array<Number, 2> middle{Number{1.0 - std::sqrt(0.5)},
                                              Number{1.0 + std::sqrt(0.5)}};
    const bool is_end = stage == 0 || stage == 3;
    const Number& weight = is_end ? half : middle[static_cast<std::size_t>(stage - 1)];
    const Number remainder = change - (is_end ? two * variable.correction : variable.correction);
    const Number moved = (stage == 3 ? sixth : weight) * remainder;
    variable.value = variable.value + moved;
    variable.correction = variable.correction + three * moved - weight * change;
  }

  template <class Print>
  void step_combined(const Print& print) {
    reset_load();          // property 2
    gill({&motor_}, [&] {  // DERC
      motor_.speed.derivative = -friction_ * motor_.speed.value - motor_.position.value + one_;
      motor_.position.derivative = motor_.speed.value;
    });
    advance_time();
    gill({&load_}, [&] { form_load_derivatives(); });
    count(print);
    if (is_ahead(load_.position.derivative - motor_.position.derivative)) combined_ = false;
  }

  template <class Print>
  void step_apart(const Print& print) {
    std::optional<Program1960> before;
    if (mending_.contact_interpolated) before = *this;
    if (mending_.shafts_together) {
      gill({&motor_, &load_}, [&] {
        form_motor_derivatives();
        form_load_derivatives();
      });
      advance_time();
    } else {
      // The load's position is that of the step before (property 3).
      gill({&motor_}, [&] { form_motor_derivatives(); });
      advance_time();
      gill({&load_}, [&] { form_load_derivatives(); });
    }
    count(print);
    if (!is_ahead(beyond_face())) return;  // TEST2, property 4
    if (before) go_back_to_contact(*before);
    contact(print);
  }

  /// DERM
  void form_motor_derivatives() {
    const Number& position =
        mending_.motor_position_in_gap ? motor_.position.value : load_.position.value;
    motor_.speed.derivative =
        (-motor_friction_ * motor_.speed.value - position + one_) / motor_inertia_;
    motor_.position.derivative = motor_.speed.value;
  }

  /// DERL
  void form_load_derivatives() {
    load_.speed.derivative = -load_rate_ * load_.speed.value;
    load_.position.derivative = load_.speed.value;
  }

  /// The load's distance beyond the far face, with the sign of the direction.
  Number beyond_face() const {
    const Number ahead = load_.position.value - motor_.position.value;
    return forward_ ? ahead - backlash_ : ahead + backlash_;
  }

  /// Goes back along straight lines between the previous and the present step to the contact.
  void go_back_to_contact(const Program1960& before) {
    const Number start = before.beyond_face();
    const Number share = start / (start - beyond_face());
    const auto go_back = [&](Number& value, const Number& from) {
      value = from + share * (value - from);
    };
    go_back(motor_.speed.value, before.motor_.speed.value);
    go_back(motor_.position.value, before.motor_.position.value);
    go_back(load_.speed.value, before.load_.speed.value);
    go_back(load_.position.value, before.load_.position.value);
    go_back(time_, before.time_);
  }

  void reset_load() {
    load_ = motor_;
    load_.speed.correction = Number{0.0};
    load_.position.correction = Number{0.0};
    if (mending_.load_derivative_its_own) form_load_derivatives();
  }

  template <class Print>
  void contact(const Print& print) {
    const Number speed = load_inertia_ * load_.speed.value + motor_inertia_ * motor_.speed.value;
    const Number& position =
        mending_.new_position_at_contact ? load_.position.value : motor_.position.value;
    motor_.speed = {-friction_ * speed - position + one_, speed, Number{0.0}};
    motor_.position = {speed, load_.position.value, Number{0.0}};  // property 4
    load_.speed = {-load_rate_ * speed, speed, Number{0.0}};
    load_.position = {speed, load_.position.value, Number{0.0}};
    print(line(true));
    forward_ = !forward_;  // SWITCH: the signs of both tests
    combined_ = true;
  }

  /// AJP 2 treats zero as positive; AJP 3, used after SWITCH, does not treat zero as negative.
  bool is_ahead(const Number& difference) const {
    const auto value = double(difference);
    return forward_ ? value >= 0.0 : value < 0.0;
  }

  void advance_time() {
    static const Number step{0.01};
    time_ = time_ + step;
  }

  template <class Print>
  void count(const Print& print) {  // property 5
    constexpr int interval = 8;
    if (++steps_since_print_ < interval) return;
    steps_since_print_ = 0;
    print(line());
  }

  Mending mending_;
  Number friction_;
  Number load_rate_;
  Number motor_inertia_;
  Number motor_friction_;
  Number load_inertia_;
  Number backlash_;
  Number one_{1.0};
  Number time_{0.0};
  Shaft motor_;
  Shaft load_;
  bool combined_ = true;
  bool forward_ = true;
  int steps_since_print_ = 0;
};

}  // namespace gearlash::thesis
