// A continuous controller, τ = C x_c + D_y y + D_v v, connected to the plant.
//
// Where the sensed speed contains β u̇, u̇ reaches the controller's states and, through the torque,
// the plant's: X′ = A X + B₁ u + B₂ u̇. The numbers X − B₂ u obey a linear flow in which u appears
// and u̇ does not.
#include "analysis/ceiling/loop_gain.hpp"
#include "analysis/ceiling/plant.hpp"
#include "numeric/decaying_motion.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;

/// Of the loop's states, and at once of what disturbs it.
struct LoopOutput {
  IntervalVector of_state{};
  Interval of_gap{0.0};
  Interval of_gap_speed{0.0};
  Interval of_torque_on_motor{0.0};
  Interval of_torque_on_load{0.0};
  Interval of_reading{0.0};
  Interval of_reference{0.0};
};

struct Model {
  IntervalMatrix flow;
  IntervalVector gap{};
  IntervalVector gap_speed{};
  IntervalVector torque_on_motor{};
  IntervalVector torque_on_load{};
  IntervalVector reading{};
  IntervalVector reference{};
  LoopOutput load{};
  LoopOutput motor{};
  LoopOutput effort{};
  std::optional<LoopOutput> gap_acceleration{};
  IntervalVector start_of_position{};
  IntervalVector start_of_speed{};
  IntervalVector start_of_gap{};
};

/// Zeros for the controller's states.
IntervalVector extended(IntervalVector of_plant, std::size_t size) {
  of_plant.resize(size, Interval(0.0));
  return of_plant;
}

/// weight_of_position · position + weight_of_speed · speed, as the controller receives them.
LoopOutput sensed(const Plant& plant, std::size_t size, const Interval& position,
                  const Interval& speed) {
  LoopOutput output;
  output.of_state = extended(
      added(scaled(position, plant.position.of_state), scaled(speed, plant.speed.of_state)), size);
  output.of_gap = position * plant.position.of_gap + speed * plant.speed.of_gap;
  output.of_gap_speed = speed * plant.speed.of_gap_speed;
  output.of_reading = position;
  return output;
}

LoopOutput seen(const PlantOutput& output, const LoopOutput& torque) {
  LoopOutput result;
  const std::size_t size = torque.of_state.size();
  result.of_state =
      added(extended(output.of_state, size), scaled(output.of_torque, torque.of_state));
  result.of_gap = output.of_gap + output.of_torque * torque.of_gap;
  result.of_gap_speed = output.of_gap_speed + output.of_torque * torque.of_gap_speed;
  result.of_torque_on_motor = output.of_torque_on_motor;
  result.of_torque_on_load = output.of_torque_on_load;
  result.of_reading = output.of_torque * torque.of_reading;
  result.of_reference = output.of_torque * torque.of_reference;
  return result;
}

void eliminate_gap_speed(Model& model) {
  model.gap = added(model.gap, times(model.flow, model.gap_speed));
  for (LoopOutput* output : {&model.load, &model.motor, &model.effort,
                             model.gap_acceleration ? &*model.gap_acceleration : nullptr}) {
    if (output == nullptr) continue;
    output->of_gap = output->of_gap + dot(output->of_state, model.gap_speed);
  }
  model.start_of_gap = added(model.start_of_gap, scaled(-1.0, model.gap_speed));
}

Model connected(const Plant& plant, const EnclosedController& controller) {
  const std::size_t order = controller.form().order();
  const auto direct = [&](std::size_t i) {
    return controller.number([i](const LinearController& c) { return c.direct[i]; });
  };
  const auto input = [&](std::size_t i, std::size_t j) {
    return controller.number([i, j](const LinearController& c) { return c.input_matrix[i][j]; });
  };
  const std::size_t first = plant.size();  // of the controller
  const std::size_t size = first + order;
  Model model{.flow = IntervalMatrix(size)};
  model.effort = sensed(plant, size, direct(1), direct(2));
  model.effort.of_reference =
      of_both(controller, [](const LinearController& c) -> auto& { return c.direct; });
  for (std::size_t i = 0; i < order; ++i) {
    model.effort.of_state[first + i] =
        controller.number([i](const LinearController& c) { return c.output[i]; });
  }
  const IntervalVector torque = extended(plant.torque, size);
  for (std::size_t i = 0; i < first; ++i) {
    model.flow.rows[i] =
        added(extended(plant.flow.rows[i], size), scaled(torque[i], model.effort.of_state));
  }
  model.gap = added(extended(plant.gap, size), scaled(model.effort.of_gap, torque));
  model.gap_speed = scaled(model.effort.of_gap_speed, torque);
  model.reading = scaled(model.effort.of_reading, torque);
  model.reference = scaled(model.effort.of_reference, torque);
  for (std::size_t i = 0; i < order; ++i) {
    LoopOutput slope = sensed(plant, size, input(i, 1), input(i, 2));
    for (std::size_t j = 0; j < order; ++j) {
      slope.of_state[first + j] =
          controller.number([i, j](const LinearController& c) { return c.state_matrix[i][j]; });
    }
    model.flow.rows[first + i] = slope.of_state;
    model.gap[first + i] = slope.of_gap;
    model.gap_speed[first + i] = slope.of_gap_speed;
    model.reading[first + i] = slope.of_reading;
    model.reference[first + i] =
        of_both(controller, [i](const LinearController& c) -> auto& { return c.input_matrix[i]; });
  }
  model.torque_on_motor = extended(plant.torque_on_motor, size);
  model.torque_on_load = extended(plant.torque_on_load, size);
  model.load = seen(plant.load, model.effort);
  model.motor = seen(plant.motor, model.effort);
  if (plant.gap_acceleration) model.gap_acceleration = seen(*plant.gap_acceleration, model.effort);
  model.start_of_position = extended(plant.start_of_position, size);
  model.start_of_speed = extended(plant.start_of_speed, size);
  model.start_of_gap = extended(plant.start_of_gap, size);
  eliminate_gap_speed(model);
  return model;
}

bool is_zero(const Interval& number) { return number.low == 0.0 && number.high == 0.0; }

class ContinuousLoop : public DisturbedLoop {
 public:
  ContinuousLoop(Model model, DecayingMotion motion)
      : model_(std::move(model)), motion_(std::move(motion)) {}

  LoopGain gain(Disturbance disturbance) override {
    std::vector<const LoopOutput*> outputs{&model_.load, &model_.motor, &model_.effort};
    if (reads_gap_speed()) outputs.push_back(&*model_.gap_acceleration);
    const std::vector<double> bounds = this->bounds(disturbance, outputs);
    LoopGain gain{.load = bounds[0], .motor = bounds[1], .effort = bounds[2]};
    if (reads_gap_speed()) gain.gap_acceleration = bounds[3];
    if (disturbance == Disturbance::gap_speed) gain.gap_acceleration = 0.0;  // a slope of its own
    return gain;
  }

  StartGain start_gain(StartOutput kind) override {
    const IntervalVector& output =
        kind == StartOutput::effort ? model_.effort.of_state : model_.gap_acceleration->of_state;
    return {.of_position = peak(model_.start_of_position, output),
            .of_speed = peak(model_.start_of_speed, output),
            .of_gap = peak(model_.start_of_gap, output)};
  }

  bool reads_gap_speed() const override { return !is_zero(model_.effort.of_gap_speed); }
  Interval gap_acceleration_per_speed() const override {
    return model_.gap_acceleration->of_gap_speed;
  }

 private:
  /// No state is disturbed by the gap's speed.
  const IntervalVector* input_of(Disturbance disturbance) const {
    switch (disturbance) {
      case Disturbance::gap:
        return &model_.gap;
      case Disturbance::torque_on_motor:
        return &model_.torque_on_motor;
      case Disturbance::torque_on_load:
        return &model_.torque_on_load;
      case Disturbance::gap_speed:
        return nullptr;
      case Disturbance::reference:
        return &model_.reference;
      default:  // the speed is measured exactly
        return &model_.reading;
    }
  }
  static Interval at_once(Disturbance disturbance, const LoopOutput& output) {
    switch (disturbance) {
      case Disturbance::gap:
        return output.of_gap;
      case Disturbance::torque_on_motor:
        return output.of_torque_on_motor;
      case Disturbance::torque_on_load:
        return output.of_torque_on_load;
      case Disturbance::gap_speed:
        return output.of_gap_speed;
      case Disturbance::reference:
        return output.of_reference;
      default:
        return output.of_reading;
    }
  }
  std::vector<double> bounds(Disturbance disturbance,
                             const std::vector<const LoopOutput*>& outputs) const {
    std::vector<IntervalVector> rows;
    for (const LoopOutput* output : outputs) rows.push_back(output->of_state);
    std::vector<Interval> norms(outputs.size(), Interval(0.0));
    if (const IntervalVector* input = input_of(disturbance)) {
      norms = motion_.impulse_norms(*input, rows);
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      result.push_back((norms[i] + abs(at_once(disturbance, *outputs[i]))).high);
    }
    return result;
  }
  /// |h| ≤ (|h(0)| + ∫|h′|)/2 for every h that tends to 0.
  double peak(const IntervalVector& start, const IntervalVector& output) const {
    const Interval twice =
        abs(dot(output, start)) + motion_.impulse_norm(times(model_.flow, start), output);
    return (0.5 * twice).high;
  }

  Model model_;
  DecayingMotion motion_;
};

Model model_of(const EnclosedDrive& drive) {
  return connected(plant_of(drive), drive.made([](const ReducedDrive& d) {
    return drive::linear_controller(d.controller);
  }));
}

}  // namespace

bool continuous_loop_decays(const ReducedDrive& drive) {
  return DecayingMotion::of(model_of(drive).flow, TimeKind::continuous).has_value();
}

std::unique_ptr<DisturbedLoop> continuous_loop(const EnclosedDrive& drive) {
  Model model = model_of(drive);
  std::optional<DecayingMotion> motion = DecayingMotion::of(model.flow, TimeKind::continuous);
  if (!motion) return nullptr;
  return std::make_unique<ContinuousLoop>(std::move(model), *std::move(motion));
}

}  // namespace gearlash
