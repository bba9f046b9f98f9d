#include "model/stepped_drive.hpp"

#include <type_traits>
#include <utility>

#include "base/number.hpp"
#include "numeric/interval_matrix.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

/// The plant after a time under one torque: rows for the states before, and the torque.
template <class Number>
std::vector<std::vector<Number>> passed(const LinearSystem<Number>& plant, const Number& time) {
  const auto size = static_cast<Eigen::Index>(plant.size());
  MatrixOf<Number> whole = MatrixOf<Number>::Constant(size + 1, size + 1, Number(0.0));
  whole.topLeftCorner(size, size) = time * flow_of(plant);
  whole.col(size).head(size) = time * vector_of(plant.column(LinearInput::torque));
  if constexpr (std::is_same_v<Number, double>) {
    return rows_of<Number>(exponential(whole).topRows(size));
  } else {
    return rows_of<Number>(enclosed_exponential(whole).topRows(size));
  }
}

template <class Number>
class Stepping {
 public:
  using Form = LinearForm<Number>;

  /// At a tick that reads the position, or at one that does not.
  Stepping(const LinearDrive<Number>& drive, TorqueInput torque, int parts, bool reads)
      : drive_(drive),
        plant_(drive.plant()),
        reads_(reads),
        last_counted_(plant_.size() + drive.order()),
        last_read_(last_counted_ + (drive.counts ? 1 : 0)),
        queue_(last_read_ + (drive.position_ticks > 1 ? 1 : 0)),
        size_(queue_ + drive.holds.front().age),
        asked_(worked_out(drive.controller.output, drive.controller.direct)),
        now_(asked_),
        parts_(parts) {
    if (torque == TorqueInput::requested) return;
    now_ = combination<Number>({}, {}, size_);
    now_[LinearInput::torque] = Number(1.0);
  }

  SteppedDrive<Number> run() {
    std::vector<Form> states;
    for (std::size_t i = 0; i < plant_.size(); ++i) states.push_back(state(i));
    for (const HeldTorqueOf<Number>& hold : drive_.holds) {
      pass(hold, hold.age == 0 ? now_ : state(queue_ + hold.age - 1), states);
    }
    const drive::LinearControllerOf<Number>& controller = drive_.controller;
    for (std::size_t i = 0; i < controller.order(); ++i) {
      states.push_back(worked_out(controller.state_matrix[i], controller.input_matrix[i]));
    }
    if (drive_.counts) {
      states.push_back(tick_form(plant_.counted));
      states.back()[LinearInput::speed_reading] = Number(1.0);
    }
    if (drive_.position_ticks > 1) states.push_back(read_position());
    for (std::size_t i = queue_; i < size_; ++i)
      states.push_back(i == queue_ ? now_ : state(i - 1));
    stepped_.last_counted = last_counted_;
    stepped_.step.slopes = std::move(states);
    stepped_.step.load = tick_form(plant_.load);
    stepped_.step.effort = asked_;
    return std::move(stepped_);
  }

 private:
  Form state(std::size_t index) const { return state_form<Number>(size_, index); }
  /// A number of the plant among all that are kept.
  Form tick_form(Form of_plant) const {
    of_plant.of_state.resize(size_, Number(0.0));
    return of_plant;
  }
  /// From a tachometer, or from the difference to the last position.
  Form sensed_speed() const {
    if (!drive_.counts) return tick_form(plant_.speed);
    Form change = tick_form(plant_.counted);
    change[LinearInput::speed_reading] = Number(1.0);
    change.of_state[last_counted_] = Number(-1.0);
    return Number(1.0) / drive_.period * std::move(change);
  }
  Form read_position() const { return reads_ ? tick_form(plant_.position) : state(last_read_); }
  Form worked_out(const std::vector<Number>& of_state, const std::vector<Number>& of_inputs) const {
    return drive_.worked_out(of_state, of_inputs, read_position(), sensed_speed(), plant_.size());
  }

  /// The plant over a hold with one torque.
  void pass(const HeldTorqueOf<Number>& hold, const Form& torque, std::vector<Form>& states) {
    const Number length =
        not_negative(hold.until - hold.from) / Number(static_cast<double>(parts_));
    const std::vector<std::vector<Number>> over = passed(plant_, length);
    for (int i = 0; i < parts_; ++i) {
      std::vector<Form> acting = states;
      acting.push_back(torque);
      std::vector<Form> slopes;
      std::vector<Form> next;
      for (std::size_t k = 0; k < plant_.size(); ++k) {
        std::vector<Number> slope = plant_.slopes[k].of_state;
        slope.push_back(plant_.slopes[k][LinearInput::torque]);
        slopes.push_back(combination(slope, acting, size_));
        next.push_back(combination(over[k], acting, size_));
      }
      stepped_.parts.push_back({.from = hold.from + Number(static_cast<double>(i)) * length,
                                .length = length,
                                .states = std::move(states),
                                .slopes = std::move(slopes),
                                .ends = {},
                                .torque = torque});
      states = std::move(next);
    }
    stepped_.parts.back().ends = states;
  }

  const LinearDrive<Number>& drive_;
  LinearSystem<Number> plant_;
  bool reads_;
  std::size_t last_counted_;
  std::size_t last_read_;
  std::size_t queue_;  ///< torques that wait
  std::size_t size_;
  Form asked_;  ///< torque worked out at the tick
  Form now_;    ///< that which acts
  int parts_;
  SteppedDrive<Number> stepped_{};
};

}  // namespace

template <class Number>
LinearForm<Number> combination(const std::vector<Number>& row,
                               const std::vector<LinearForm<Number>>& forms, std::size_t size) {
  LinearForm<Number> form{std::vector<Number>(size, Number(0.0)), {}};
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!is_exactly(row[i], 0.0)) form = std::move(form) + row[i] * forms[i];
  }
  return form;
}

template <class Number>
SteppedDrive<Number> stepped_drive(const LinearDrive<Number>& drive, TorqueInput torque,
                                   int parts) {
  SteppedDrive<Number> stepped = Stepping<Number>(drive, torque, parts, true).run();
  if (drive.position_ticks == 1) return stepped;
  const SteppedDrive<Number> holding = Stepping<Number>(drive, torque, parts, false).run();
  for (int i = 1; i < drive.position_ticks; ++i) {
    stepped.step.slopes = of_each(holding.step.slopes, [&](const LinearForm<Number>& next) {
      LinearForm<Number> form =
          combination(next.of_state, stepped.step.slopes, next.of_state.size());
      for (std::size_t k = 0; k < linear_inputs; ++k) {
        form.of_inputs[k] = form.of_inputs[k] + next.of_inputs[k];
      }
      return form;
    });
  }
  return stepped;
}

template LinearForm<Interval> combination(const std::vector<Interval>&,
                                          const std::vector<LinearForm<Interval>>&, std::size_t);
template SteppedDrive<double> stepped_drive(const LinearDrive<double>&, TorqueInput, int);
template SteppedDrive<Interval> stepped_drive(const LinearDrive<Interval>&, TorqueInput, int);

}  // namespace gearlash
