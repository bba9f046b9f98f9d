// Two shafts with dry friction and a gap between them, carried forward by small steps.
#pragma once

#include "computer.hpp"
#include "plain_drive.hpp"

namespace gearlash::oracle {

/// The motor's torque: held − stiffness (y − PlainDrive::reference) − damping v, within the limit.
/// A sampled controller holds it. With a current_rate it tends to held: a step has the mean torque.
struct AppliedTorque {
  double held = 0.0;       ///< N m
  double stiffness = 0.0;  ///< N m/rad
  double damping = 0.0;    ///< N m s/rad
};

/// Rules of one step, of length h:
///   accelerations are those at its middle (second order), constant over the step;
///   the step is cut where a shaft's speed passes 0, where a face is reached, and where faces part;
///   a shaft that stopped sticks while the torque applied to it is at most its breakaway torque;
///   rigid faces: momentum is kept and the relative speed multiplied by −e; bounces shorter than a
///   hundredth of h are over at once; in contact both move as one while the faces press;
///   compliant faces: spring and damper in parallel, which never pull; without a gap they do.
class Mechanism {
 public:
  Mechanism(const PlainDrive& drive, const ShaftReadings& start);

  void advance(double step, const AppliedTorque& torque);
  void set_load_torque(double torque) { drive_.load_torque = torque; }  ///< N m

  [[nodiscard]] const ShaftReadings& shafts() const { return now_; }
  [[nodiscard]] bool stands() const { return now_.motor_speed == 0.0 && now_.load_speed == 0.0; }
  /// s: ends of steps that had more cuts than are followed.
  [[nodiscard]] double left_out() const { return left_out_; }
  /// Extremes since the last call of forget_extremes().
  [[nodiscard]] double lowest_load() const { return lowest_load_; }
  [[nodiscard]] double highest_load() const { return highest_load_; }
  [[nodiscard]] double lowest_motor() const { return lowest_motor_; }
  [[nodiscard]] double highest_motor() const { return highest_motor_; }
  void forget_extremes();

 private:
  struct Accelerations {
    double motor = 0.0;
    double load = 0.0;
  };
  enum class Cut { none, motor_stops, load_stops, meets_forward, meets_backward };

  void advance_shafts(double step, const AppliedTorque& torque);
  [[nodiscard]] double motor_torque(const ShaftReadings& at, const AppliedTorque& torque) const;
  [[nodiscard]] double load_torque(const ShaftReadings& at) const;
  [[nodiscard]] double mesh_torque(const ShaftReadings& at) const;
  [[nodiscard]] Accelerations accelerations(const ShaftReadings& at,
                                            const AppliedTorque& torque) const;
  void break_away(const AppliedTorque& torque);
  void break_away_together(double torque);
  void part(const AppliedTorque& torque);
  [[nodiscard]] double time_to_face(double face, const Accelerations& rate) const;
  void move(double time, const Accelerations& rate);
  void meet(double face, double step, const AppliedTorque& torque);
  void engage(double face);
  double cut_step(double remaining, double step, const AppliedTorque& torque);
  void note_extremes();

  PlainDrive drive_;
  bool is_rigid_ = true;
  ShaftReadings now_;
  int motor_way_ = 0;  ///< direction of the dry friction; 0: sticks
  int load_way_ = 0;
  double current_ = 0.0;  ///< N m, the torque of the motor's current, with a current_rate
  int face_ = 0;          ///< of rigid faces in contact
  double left_out_ = 0.0;
  double lowest_load_ = 0.0, highest_load_ = 0.0, lowest_motor_ = 0.0, highest_motor_ = 0.0;
};

}  // namespace gearlash::oracle
