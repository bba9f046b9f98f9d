// The loop of a continuous controller, x′ = A x + B u: the largest |c x| that |u| ≤ 1 can cause is
// ∫|c e^{At} B| dt.
#include "base/lists.hpp"
#include "numeric/decaying_motion.hpp"
#include "question/loop/ceiling/loop_gain.hpp"

namespace gearlash {
namespace {

using Form = LinearForm<Interval>;

class ContinuousLoop : public DisturbedLoop {
 public:
  ContinuousLoop(LinearSystem<Interval> loop, DecayingMotion motion)
      : loop_(std::move(loop)), motion_(std::move(motion)) {}

  LoopGain gain(const Disturbance& disturbance) override {
    std::vector<const Form*> outputs{&loop_.load, &loop_.motor, &loop_.effort};
    if (reads_gap_speed()) outputs.push_back(&*loop_.gap_acceleration);
    const std::vector<double> bounds = this->bounds(disturbance, outputs);
    LoopGain gain{.load = bounds[0], .motor = bounds[1], .effort = bounds[2]};
    const bool has_slope_of_its_own = disturbance.front() == LinearInput::gap_speed;
    if (reads_gap_speed()) gain.gap_acceleration = has_slope_of_its_own ? 0.0 : bounds[3];
    return gain;
  }

  StartGain start_gain(StartOutput kind) override {
    const IntervalVector& output =
        kind == StartOutput::effort ? loop_.effort.of_state : loop_.gap_acceleration->of_state;
    return {.of_position = peak(loop_.start_of_position, output),
            .of_speed = peak(loop_.start_of_speed, output),
            .of_gap = peak(loop_.start_of_gap, output)};
  }

  bool reads_gap_speed() const override {
    return !is_exactly(loop_.effort[LinearInput::gap_speed], 0.0);
  }
  Interval gap_acceleration_per_speed() const override {
    return (*loop_.gap_acceleration)[LinearInput::gap_speed];
  }

 private:
  std::vector<double> bounds(const Disturbance& disturbance,
                             const std::vector<const Form*>& outputs) const {
    const std::vector<Interval> norms = motion_.impulse_norms(
        at_once(loop_.slopes, disturbance),
        of_each(outputs, [](const Form* output) { return output->of_state; }));
    return of_each(indices(outputs.size()), [&](std::size_t i) {
      return (norms[i] + abs(at_once(*outputs[i], disturbance))).high;
    });
  }
  /// |h| ≤ (|h(0)| + ∫|h′|)/2 for every h that tends to 0.
  double peak(const IntervalVector& start, const IntervalVector& output) const {
    const Interval twice =
        abs(dot(output, start)) + motion_.impulse_norm(times(flow_of(loop_), start), output);
    return (0.5 * twice).high;
  }

  LinearSystem<Interval> loop_;
  DecayingMotion motion_;
};

}  // namespace

std::unique_ptr<DisturbedLoop> continuous_loop(const LinearDrive<Interval>& drive) {
  LinearSystem<Interval> loop = drive.loop();
  std::optional<DecayingMotion> motion = DecayingMotion::of(flow_of(loop), TimeKind::continuous);
  if (!motion) return nullptr;
  return std::make_unique<ContinuousLoop>(std::move(loop), *std::move(motion));
}

}  // namespace gearlash
