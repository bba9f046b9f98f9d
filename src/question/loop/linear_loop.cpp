#include "question/loop/linear_loop.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "general/assemble/time_scale.hpp"
#include "model/linear_drive.hpp"
#include "numeric/linear_algebra.hpp"
#include "question/loop/ceiling/loop_gain.hpp"

namespace gearlash::drive {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Vector = Eigen::VectorXcd;
using Row = Eigen::RowVectorXcd;

Vector vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

// ---- the response -------------------------------------------------------------------------------

/// A torque's effect on the plant's states, some ticks later.
struct DelayedTorque {
  Vector effect;
  std::size_t age = 0;
};

/// (advance − flow) x = Σ effect advance^−age τ, where `advance` is jω, or e^{jωT} from tick to
/// tick.
struct PlantMotion {
  Matrix flow;
  std::vector<DelayedTorque> torques;
};

/// Over a time under one torque, e^{A t} and ∫e^{A s} ds b: the torque is a state that stands.
struct Passage {
  Eigen::MatrixXd flow;
  Eigen::VectorXd of_torque;
};
Passage passage(const Eigen::MatrixXd& flow, const Eigen::VectorXd& of_torque, double time) {
  const Eigen::Index size = flow.rows();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(size + 1, size + 1);
  whole.topLeftCorner(size, size) = time * flow;
  whole.topRightCorner(size, 1) = time * of_torque;
  const Eigen::MatrixXd passed = exponential(whole);
  return {passed.topLeftCorner(size, size), passed.topRightCorner(size, 1)};
}

PlantMotion motion_of(const LinearDrive<double>& drive, const LinearSystem<double>& plant) {
  const auto size = static_cast<Eigen::Index>(plant.size());
  Eigen::MatrixXd flow(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    flow.row(i) = vector_of(plant.slopes[static_cast<std::size_t>(i)].of_state).real().transpose();
  }
  const Eigen::VectorXd of_torque = vector_of(plant.column(LinearInput::torque)).real();
  if (drive.holds.empty()) return {flow, {{of_torque, 0}}};
  PlantMotion motion{passage(flow, of_torque, drive.period).flow, {}};
  for (const HeldTorque& held : drive.holds) {
    const Passage during = passage(flow, of_torque, held.until - held.from);
    const Passage after = passage(flow, of_torque, drive.period - held.until);
    motion.torques.push_back({Vector(after.flow * during.of_torque), held.age});
  }
  return motion;
}

/// At one frequency.
struct LoopResponse {
  Complex open;    ///< L
  Complex closed;  ///< θ_L/r
};

class LoopTransfer {
 public:
  explicit LoopTransfer(const LinearDrive<double>& drive);

  LoopResponse at(double frequency) const {
    const Complex advance = period_ > 0.0 ? std::polar(1.0, frequency * period_)  //
                                          : Complex{0.0, frequency};
    const Vector states = of_torque(advance);
    const Row controller = of_inputs(advance);
    const Complex position = position_.dot(states);
    const Complex speed =
        counts_ ? (1.0 - 1.0 / advance) / period_ * counted_.dot(states) : speed_.dot(states);
    const Complex open = -(controller[1] * position + controller[2] * speed);
    return {open, controller[0] * load_.dot(states) / (1.0 + open)};
  }

 private:
  Vector of_torque(const Complex& advance) const;
  Row of_inputs(const Complex& advance) const;

  PlantMotion motion_;
  double period_ = 0.0;  ///< s; 0 of a continuous controller
  bool counts_ = false;  ///< the speed is a difference of positions
  Vector load_;
  Vector position_;
  Vector counted_;
  Vector speed_;
  Matrix controller_flow_;
  Matrix controller_inputs_;
  Row controller_output_;
  Row direct_;
};

/// Of the reference, the position and the speed. The row has the sum of the first two.
Row inputs_of(const ControllerRow<double>& row) {
  Row inputs(3);
  inputs << row.reference - row.position, row.position, row.speed;
  return inputs;
}

LoopTransfer::LoopTransfer(const LinearDrive<double>& drive)
    : period_(drive.period), counts_(drive.counts) {
  const LinearSystem<double> plant = drive.plant();
  motion_ = motion_of(drive, plant);
  load_ = vector_of(plant.load.of_state);
  position_ = vector_of(plant.position.of_state);
  counted_ = vector_of(plant.counted.of_state);
  speed_ = vector_of(plant.speed.of_state);
  const auto order = static_cast<Eigen::Index>(drive.order());
  controller_flow_.resize(order, order);
  controller_inputs_.resize(order, 3);
  for (Eigen::Index i = 0; i < order; ++i) {
    const ControllerRow<double>& row = drive.controller_states[static_cast<std::size_t>(i)];
    controller_flow_.row(i) = vector_of(row.of_state).transpose();
    controller_inputs_.row(i) = inputs_of(row);
  }
  controller_output_ = vector_of(drive.torque.of_state).transpose();
  direct_ = inputs_of(drive.torque);
}

/// (advance − flow)⁻¹ right.
Matrix resolved(const Complex& advance, const Matrix& flow, const Matrix& right) {
  return solved(Matrix(advance * Matrix::Identity(flow.rows(), flow.cols()) - flow), right);
}

/// The plant's states per requested torque.
Vector LoopTransfer::of_torque(const Complex& advance) const {
  Vector acting = Vector::Zero(motion_.flow.rows());
  for (const DelayedTorque& torque : motion_.torques) {
    acting += torque.effect / std::pow(advance, static_cast<int>(torque.age));
  }
  return resolved(advance, motion_.flow, acting);
}

/// K_r, K_y and K_v.
Row LoopTransfer::of_inputs(const Complex& advance) const {
  if (controller_output_.size() == 0) return direct_;
  return direct_ + controller_output_ * resolved(advance, controller_flow_, controller_inputs_);
}

// ---- frequencies --------------------------------------------------------------------------------

/// Where responses are sampled, rad/s; none if nothing moves. The first stands for frequency 0.
std::vector<double> sampled_frequencies(const ReducedDrive& drive) {
  const std::vector<Complex> eigenvalues = loop_eigenvalues(drive);
  if (eigenvalues.empty()) return {};
  double slowest = std::numeric_limits<double>::infinity();
  double fastest = 0.0;
  for (const Complex& value : eigenvalues) {
    slowest = std::min(slowest, std::abs(value));
    fastest = std::max(fastest, std::abs(value));
  }
  constexpr double beyond = 1e4;            // of the slopes at high frequencies
  constexpr double at_rest = 1e-6;          // responses differ from those at 0 by its square
  constexpr double below_end = 1.0 - 1e-6;  // Tustin's rule may put a pole at z = −1
  const double end =
      drive.sampling ? std::numbers::pi / drive.sampling->period * below_end : beyond * fastest;
  const double begin = at_rest * std::min(slowest, end);
  constexpr double steps_per_decade = 64.0;
  const double steps = std::ceil(steps_per_decade * std::log10(end / begin));
  std::vector<double> frequencies;
  for (double i = 0.0; i <= steps; i += 1.0) {
    frequencies.push_back(begin * std::pow(end / begin, i / steps));
  }
  for (const Complex& value : eigenvalues) {
    for (const double widths : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
      for (const double side : {-1.0, 1.0}) {
        const double near = std::abs(value.imag()) + side * widths * std::abs(value.real());
        if (near > begin && near < end) frequencies.push_back(near);
      }
    }
  }
  std::sort(frequencies.begin(), frequencies.end());
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
  return frequencies;
}

struct FrequencySample {
  double frequency = 0.0;
  double value = 0.0;
};

/// Samples, and the extremes between them that cross 0.
template <class Function>
std::vector<FrequencySample> samples_of(const Function& function,
                                        const std::vector<double>& frequencies) {
  std::vector<FrequencySample> samples;
  for (const double frequency : frequencies) {
    const double value = function(frequency);
    if (std::isfinite(value)) samples.push_back({frequency, value});
  }
  std::vector<FrequencySample> extremes;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double sign = samples[i].value < 0.0 ? -1.0 : 1.0;
    const auto depth = [&](const FrequencySample& sample) { return sign * sample.value; };
    const bool is_least =
        depth(samples[i]) <= depth(samples[i - 1]) && depth(samples[i]) <= depth(samples[i + 1]);
    if (!is_least) continue;
    constexpr int half_of_the_digits = std::numeric_limits<double>::digits / 2;
    std::uintmax_t most = 100;
    const auto [frequency, least] = boost::math::tools::brent_find_minima(
        [&](double at) { return sign * function(at); }, samples[i - 1].frequency,
        samples[i + 1].frequency, half_of_the_digits, most);
    if (least < 0.0 && std::isfinite(least)) extremes.push_back({frequency, sign * least});
  }
  samples.insert(samples.end(), extremes.begin(), extremes.end());
  std::sort(samples.begin(), samples.end(), [](const FrequencySample& a, const FrequencySample& b) {
    return a.frequency < b.frequency;
  });
  return samples;
}

/// Where a function of the frequency crosses 0, in order.
template <class Function>
std::vector<double> crossings(const Function& function, const std::vector<double>& frequencies) {
  const std::vector<FrequencySample> samples = samples_of(function, frequencies);
  std::vector<double> found;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& [low, at_low] = samples[i - 1];
    const auto& [high, at_high] = samples[i];
    if ((at_low < 0.0) == (at_high < 0.0)) continue;
    std::uintmax_t most = 100;
    const auto is_close = [](double a, double b) {
      return b - a <= 4.0 * std::numeric_limits<double>::epsilon() * b;
    };
    const auto [below, above] =
        boost::math::tools::toms748_solve(function, low, high, at_low, at_high, is_close, most);
    found.push_back(0.5 * (below + above));
  }
  return found;
}

}  // namespace

std::optional<LinearLoop> loop_figures(const ReducedDrive& drive) {
  require_none(faults(drive));
  if (drive.error_shape.is_relay()) return std::nullopt;
  LinearLoop figures;
  figures.is_stable = loop_decays(linear_drive(EnclosedDrive(drive)));
  const std::vector<double> frequencies = sampled_frequencies(drive);
  if (!figures.is_stable || frequencies.empty()) return figures;
  const LoopTransfer loop(linear_drive(drive));
  constexpr double turn = 2.0 * std::numbers::pi;  // from rad/s to Hz
  const double at_rest = std::abs(loop.at(frequencies.front()).closed);
  const std::vector<double> falls = crossings(
      [&](double frequency) {
        return std::log(std::abs(loop.at(frequency).closed) / at_rest) + 0.5 * std::numbers::ln2;
      },
      frequencies);
  if (!falls.empty()) figures.bandwidth = falls.front() / turn;
  for (const double frequency :
       crossings([&](double at) { return std::log(std::abs(loop.at(at).open)); }, frequencies)) {
    const double margin = std::abs(std::arg(-loop.at(frequency).open));
    if (figures.phase_margin && *figures.phase_margin <= margin) continue;
    figures.phase_margin = margin;
    figures.crossover = frequency / turn;
  }
  return figures;
}

}  // namespace gearlash::drive
