#include "question/loop/linear_loop.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "base/lists.hpp"
#include "general/assemble/time_scale.hpp"
#include "model/stepped_drive.hpp"
#include "numeric/elimination.hpp"
#include "numeric/linear_algebra.hpp"
#include "numeric/zero_between.hpp"
#include "question/loop/ceiling/loop_gain.hpp"

namespace gearlash::drive {
namespace {

using Complex = std::complex<double>;

// ---- the response -------------------------------------------------------------------------------

/// At one frequency.
struct LoopResponse {
  Complex open;       ///< L
  Complex closed;     ///< θ_L/r
  Complex by_torque;  ///< θ_L per torque that is added to the controller's
};

/// What the reference adds at once. Of a form `reference` is its effect together with an equal
/// position's.
double by_reference(const LinearForm<double>& form) {
  return form[LinearInput::reference] - form[LinearInput::position_reading];
}

/// (advance − flow) x = inputs (τ, r), where `advance` is jω, or e^{jωT} from tick to tick.
class LoopTransfer {
 public:
  explicit LoopTransfer(const LinearDrive<double>& drive) : period_(drive.period) {
    const LinearSystem<double> open =
        drive.holds.empty() ? drive.open() : stepped_drive(drive, TorqueInput::open).step;
    flow_ = flow_of(open);
    inputs_.resize(flow_.rows(), 2);
    for (Eigen::Index i = 0; i < flow_.rows(); ++i) {
      const LinearForm<double>& slope = open.slopes[static_cast<std::size_t>(i)];
      inputs_(i, 0) = slope[LinearInput::torque];
      inputs_(i, 1) = by_reference(slope);
    }
    load_ = vector_of(open.load.of_state).transpose();
    effort_ = vector_of(open.effort.of_state).transpose();
    effort_by_reference_ = by_reference(open.effort);
  }

  double period() const { return period_; }

  const LoopResponse& at(double frequency) const {
    const auto [place, is_new] = kept_.try_emplace(frequency);
    if (is_new) place->second = response(frequency);
    return place->second;
  }

  /// s, |r − θ_L| of a ramp of 1 rad/s in the end; empty if it grows. The states of the loop, flow
  /// F and inputs by the reference R, follow as a + b t with F b = −R and F a = b.
  std::optional<double> lag_of_ramp() const {
    Eigen::MatrixXd flow = (flow_ + inputs_.col(0) * effort_).real();
    Eigen::VectorXd inputs = (inputs_.col(1) + effort_by_reference_ * inputs_.col(0)).real();
    if (period_ > 0.0) {
      flow = (flow - Eigen::MatrixXd::Identity(flow.rows(), flow.cols())) / period_;
      inputs /= period_;
    }
    const Eigen::VectorXd rates = solved(flow, Eigen::VectorXd(-inputs));
    constexpr double rounding = 1e-9;
    if (!(std::abs((load_.real() * rates).value() - 1.0) <= rounding)) return std::nullopt;
    return -(load_.real() * solved(flow, rates)).value();
  }

 private:
  LoopResponse response(double frequency) const {
    const Complex advance = period_ > 0.0 ? std::polar(1.0, frequency * period_)  //
                                          : Complex{0.0, frequency};
    const Eigen::MatrixXcd states = solved(
        Eigen::MatrixXcd(advance * Eigen::MatrixXcd::Identity(flow_.rows(), flow_.cols()) - flow_),
        inputs_);
    const Complex open = -(effort_ * states.col(0)).value();
    const Complex requested = (effort_ * states.col(1)).value() + effort_by_reference_;
    const Complex by_torque = (load_ * states.col(0)).value() / (1.0 + open);
    return {open, requested * by_torque, by_torque};
  }

  double period_ = 0.0;  ///< s; 0 of a continuous controller
  Eigen::MatrixXcd flow_;
  Eigen::MatrixXcd inputs_;
  Eigen::RowVectorXcd load_;
  Eigen::RowVectorXcd effort_;
  double effort_by_reference_ = 0.0;
  mutable std::map<double, LoopResponse> kept_;  ///< for the next figure
};

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
  add_all(samples, extremes);
  sort_by(samples, &FrequencySample::frequency);
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
    found.push_back(zero_between(low, high, at_low, at_high, function));
  }
  return found;
}

// ---- figures ------------------------------------------------------------------------------------

constexpr double turn = 2.0 * std::numbers::pi;  // from rad/s to Hz

std::optional<double> bandwidth_of(const LoopTransfer& loop,
                                   const std::vector<double>& frequencies) {
  const double at_rest = std::abs(loop.at(frequencies.front()).closed);
  const std::vector<double> falls = crossings(
      [&](double frequency) {
        return std::log(std::abs(loop.at(frequency).closed) / at_rest) + 0.5 * std::numbers::ln2;
      },
      frequencies);
  return falls.empty() ? std::nullopt : std::optional(falls.front() / turn);
}

void add_phase_margin(const LoopTransfer& loop, const std::vector<double>& frequencies,
                      LinearLoop& figures) {
  for (const double frequency :
       crossings([&](double at) { return std::log(std::abs(loop.at(at).open)); }, frequencies)) {
    const double margin = std::abs(std::arg(-loop.at(frequency).open));
    if (figures.phase_margin && *figures.phase_margin <= margin) continue;
    figures.phase_margin = margin;
    figures.crossover = frequency / turn;
  }
}

/// Where L is real, and where it passes through infinity or 0; and the ends at which it is real, 0
/// and half the sampling frequency, unless it has a pole there.
std::vector<double> real_frequencies(const LoopTransfer& loop,
                                     const std::vector<double>& frequencies) {
  std::vector<double> found = crossings(
      [&](double at) {
        const Complex open = loop.at(at).open;
        return open.imag() / std::abs(open);
      },
      frequencies);
  const auto add_end = [&](double end, double beside) {
    constexpr double same = 1e-3;
    const Complex near = loop.at(beside).open;
    if (std::abs(loop.at(end).open - near) <= same * std::abs(near)) found.push_back(end);
  };
  add_end(0.0, frequencies.front());
  if (loop.period() > 0.0) add_end(std::numbers::pi / loop.period(), frequencies.back());
  return found;
}

void add_gain_margin(const LoopTransfer& loop, const std::vector<double>& frequencies,
                     LinearLoop& figures) {
  constexpr double rounding = 1e-6;  // of L, where it is real
  double nearest = std::log(1e6);    // beyond this factor roundings decide where L is real
  for (const double frequency : real_frequencies(loop, frequencies)) {
    const Complex open = loop.at(frequency).open;
    const double distance = std::abs(std::log(-open.real()));
    const bool is_negative = std::abs(open.imag()) <= rounding * -open.real();
    if (!is_negative || !(distance < nearest)) continue;
    nearest = distance;
    figures.gain_margin = -1.0 / open.real();
    figures.phase_crossover = frequency / turn;
  }
}

/// LinearLoop::lag. Feed-forward leads the reference, and adds torque by its acceleration.
std::optional<double> lag_of(const LoopTransfer& loop, const Signal& reference,
                             const Feedforward& forward) {
  if (const auto* ramp = std::get_if<Ramp>(&reference)) {
    const std::optional<double> lag = loop.lag_of_ramp();
    return lag ? std::optional(std::abs(ramp->rate * (*lag - forward.lead))) : std::nullopt;
  }
  const auto* sine = std::get_if<Sine>(&reference);
  if (sine == nullptr) return std::nullopt;
  const LoopResponse response = loop.at(sine->frequency);
  const Complex derivative{0.0, sine->frequency};
  const Complex followed = response.closed * (1.0 + forward.lead * derivative) +
                           response.by_torque * forward.inertia * derivative * derivative;
  return std::abs(sine->amplitude) * std::abs(1.0 - followed);
}

}  // namespace

std::optional<LinearLoop> loop_figures(const ReducedDrive& drive) {
  require_none(faults(drive));
  if (drive.error_shape.is_relay()) return std::nullopt;
  LinearLoop figures;
  figures.is_stable = loop_decays(linear_drive(EnclosedDrive(drive)));
  if (drive.sampling && position_ticks(*drive.sampling) > 1) return figures;
  const std::vector<double> frequencies = sampled_frequencies(drive);
  if (!figures.is_stable || frequencies.empty()) return figures;
  const LoopTransfer loop(linear_drive(drive));
  figures.bandwidth = bandwidth_of(loop, frequencies);
  add_phase_margin(loop, frequencies, figures);
  add_gain_margin(loop, frequencies, figures);
  figures.lag = lag_of(loop, settled(drive.reference), drive.feedforward);
  return figures;
}

}  // namespace gearlash::drive
