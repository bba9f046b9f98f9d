#include "analysis/linear_loop.hpp"

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

#include "analysis/ceiling/held_torques.hpp"
#include "analysis/ceiling/loop_gain.hpp"
#include "analysis/ceiling/plant.hpp"
#include "general/assemble/time_scale.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Vector = Eigen::VectorXcd;
using Row = Eigen::RowVectorXcd;

Complex middle_of(const Interval& interval) { return 0.5 * interval.low + 0.5 * interval.high; }

Vector middle_of(const IntervalVector& numbers) {
  Vector middle(static_cast<Eigen::Index>(numbers.size()));
  for (Eigen::Index i = 0; i < middle.size(); ++i) {
    middle[i] = middle_of(numbers[static_cast<std::size_t>(i)]);
  }
  return middle;
}

Matrix middle_of(const IntervalMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.size());
  Matrix middle(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    middle.row(i) = middle_of(matrix.rows[static_cast<std::size_t>(i)]).transpose();
  }
  return middle;
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

PlantMotion motion_of(const Plant& plant, const std::optional<Sampling>& sampling) {
  if (!sampling) return {middle_of(plant.flow), {{middle_of(plant.torque), 0}}};
  PlantMotion motion{middle_of(passage(plant.flow, {}, sampling->period).flow), {}};
  for (const HeldTorque& held : held_torques(*sampling)) {
    const LinearPassage during = passage(plant.flow, {plant.torque}, held.until - held.from);
    const LinearPassage after = passage(plant.flow, {}, sampling->period - held.until);
    motion.torques.push_back({middle_of(times(after.flow, during.of_inputs[0])), held.age});
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
  explicit LoopTransfer(const ReducedDrive& drive)
      : LoopTransfer(gearlash::plant_of(drive), drive.sampling,
                     drive.sampling ? sampled_controller(drive.controller, *drive.sampling)
                                    : linear_controller(drive.controller)) {}

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
  LoopTransfer(const Plant& plant, const std::optional<Sampling>& sampling,
               const LinearController& controller);
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

LoopTransfer::LoopTransfer(const Plant& plant, const std::optional<Sampling>& sampling,
                           const LinearController& controller)
    : motion_(motion_of(plant, sampling)),
      period_(sampling ? sampling->period : 0.0),
      counts_(sampling && sampling->speed_by_differences),
      load_(middle_of(plant.load.of_state)),
      position_(middle_of(plant.position.of_state)),
      counted_(middle_of(plant.counted.of_state)),
      speed_(middle_of(plant.speed.of_state)),
      controller_flow_(controller.order(), controller.order()),
      controller_inputs_(controller.order(), 3),
      controller_output_(controller.order()),
      direct_(3) {
  for (Eigen::Index i = 0; i < controller_output_.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    controller_output_[i] = controller.output[row];
    for (Eigen::Index j = 0; j < controller_output_.size(); ++j) {
      controller_flow_(i, j) = controller.state_matrix[row][static_cast<std::size_t>(j)];
    }
    for (Eigen::Index j = 0; j < 3; ++j) {
      controller_inputs_(i, j) = controller.input_matrix[row][static_cast<std::size_t>(j)];
    }
  }
  for (Eigen::Index j = 0; j < 3; ++j) direct_[j] = controller.direct[static_cast<std::size_t>(j)];
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

struct Sample {
  double frequency = 0.0;
  double value = 0.0;
};

/// Samples, and the extremes between them that cross 0.
template <class Function>
std::vector<Sample> samples_of(const Function& function, const std::vector<double>& frequencies) {
  std::vector<Sample> samples;
  for (const double frequency : frequencies) {
    const double value = function(frequency);
    if (std::isfinite(value)) samples.push_back({frequency, value});
  }
  std::vector<Sample> extremes;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double sign = samples[i].value < 0.0 ? -1.0 : 1.0;
    const auto depth = [&](const Sample& sample) { return sign * sample.value; };
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
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.frequency < b.frequency; });
  return samples;
}

/// Where a function of the frequency crosses 0, in order.
template <class Function>
std::vector<double> crossings(const Function& function, const std::vector<double>& frequencies) {
  const std::vector<Sample> samples = samples_of(function, frequencies);
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
  require_none(validate(drive));
  if (drive.error_shape.is_relay()) return std::nullopt;
  LinearLoop figures;
  figures.is_stable = drive.sampling ? sampled_loop_decays(drive) : continuous_loop_decays(drive);
  const std::vector<double> frequencies = sampled_frequencies(drive);
  if (!figures.is_stable || frequencies.empty()) return figures;
  const LoopTransfer loop(drive);
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
