#include "hybrid/hybrid_system.hpp"

#include <cmath>

namespace gearlash::hybrid {
namespace {

/// Notes what is wrong, and where.
class Inspection {
 public:
  explicit Inspection(const HybridSystem& system) : system_(system), size_(system.size()) {}

  std::vector<std::string> faults() {
    if (size_ == 0) note("state_names", "must name at least one number");
    if (system_.modes.empty()) note("modes", "must have at least one");
    for (const Clock& clock : system_.clocks) inspect(clock);
    for (const Mode& mode : system_.modes) inspect(mode);
    return std::move(faults_);
  }

 private:
  void note(const std::string& where, const std::string& what) {
    faults_.push_back(where + ": " + what);
  }

  void expect_vector(const std::string& where, const Vector& vector, bool may_be_empty) {
    if (may_be_empty && vector.size() == 0) return;
    if (vector.size() != size_) {
      note(where,
           "has " + std::to_string(vector.size()) + " numbers, must have " + std::to_string(size_));
    } else if (!vector.allFinite()) {
      note(where, "must be finite");
    }
  }

  void expect_matrix(const std::string& where, const Matrix& matrix, bool may_be_empty) {
    if (may_be_empty && matrix.size() == 0) return;
    if (matrix.rows() != size_ || matrix.cols() != size_) {
      note(where, "is " + std::to_string(matrix.rows()) + " by " + std::to_string(matrix.cols()) +
                      ", must be " + std::to_string(size_) + " by " + std::to_string(size_));
    } else if (!matrix.allFinite()) {
      note(where, "must be finite");
    }
  }

  void expect_mode(const std::string& where, std::size_t target) {
    if (target < system_.modes.size()) return;
    note(where, "is mode " + std::to_string(target) + ", must be one of " +
                    std::to_string(system_.modes.size()) + " modes, from 0 on");
  }

  void inspect(const std::string& where, const AffineForm& form) {
    expect_vector(where + ".normal", form.normal, false);
    if (!std::isfinite(form.offset)) note(where + ".offset", "must be finite");
  }

  void inspect(const std::string& where, const std::vector<Alternative>& alternatives) {
    for (const Alternative& alternative : alternatives) {
      for (const AffineForm& form : alternative.positive) inspect(where + ".positive", form);
      expect_mode(where + ".target", alternative.target);
    }
  }

  void inspect(const std::string& where, const Reset& reset) {
    expect_matrix(where + ".matrix", reset.matrix, true);
    expect_vector(where + ".offset", reset.offset, true);
    for (const Quantizer& quantizer : reset.quantizers) {
      inspect(where + ".quantizer.measured", quantizer.measured);
      expect_vector(where + ".quantizer.gain", quantizer.gain, false);
      if (!(quantizer.step > 0.0 && std::isfinite(quantizer.step))) {
        note(where + ".quantizer.step", "must be positive and finite");
      }
    }
  }

  void inspect(const Clock& clock) {
    const std::string where = "clock \"" + clock.name + "\"";
    if (!std::isfinite(clock.first) || !std::isfinite(clock.period) || clock.period < 0.0) {
      note(where, "must have a finite first tick and a period of at least 0");
    }
    if (clock.period == 0.0 && clock.times.empty()) note(where, "must have a period or times");
    if (clock.period > 0.0 && !clock.times.empty()) {
      note(where, "must have a period or times, not both");
    }
    for (std::size_t i = 0; i < clock.times.size(); ++i) {
      const bool rises = i == 0 || clock.times[i] > clock.times[i - 1];
      if (std::isfinite(clock.times[i]) && rises) continue;
      note(where, "times must be finite and rise; entry " + std::to_string(i) + " does not");
    }
    if (!clock.additions.empty() && clock.additions.size() != clock.times.size()) {
      note(where, "must have as many additions as times, or none");
    }
    for (const Vector& addition : clock.additions) {
      expect_vector(where + ".additions", addition, false);
    }
  }

  void inspect(const Mode& mode) {
    const std::string where = "mode \"" + mode.name + "\"";
    expect_matrix(where + ".flow.matrix", mode.flow.matrix, false);
    expect_vector(where + ".flow.offset", mode.flow.offset, false);
    for (const Transition& transition : mode.transitions) {
      const std::string here = where + ", transition \"" + transition.name + "\"";
      inspect(here + ".guard", transition.guard);
      inspect(here + ".reset", transition.reset);
      expect_mode(here + ".target", transition.target);
      inspect(here + ".alternatives", transition.alternatives);
      if (!transition.settling) continue;
      inspect(here + ".settling.reset", transition.settling->reset);
      expect_mode(here + ".settling.target", transition.settling->target);
      inspect(here + ".settling.alternatives", transition.settling->alternatives);
    }
    for (const TimedTransition& transition : mode.timed) {
      const std::string here = where + ", timed transition \"" + transition.name + "\"";
      inspect(here + ".reset", transition.reset);
      expect_mode(here + ".target", transition.target);
      inspect(here + ".alternatives", transition.alternatives);
      if (transition.clock >= system_.clocks.size()) {
        note(here + ".clock", "is clock " + std::to_string(transition.clock) + ", must be one of " +
                                  std::to_string(system_.clocks.size()));
      }
    }
  }

  const HybridSystem& system_;
  Eigen::Index size_;
  std::vector<std::string> faults_;
};

}  // namespace

double Quantizer::reading(const Vector& state) const {
  return step * std::round(measured.at(state) / step);
}

Vector Reset::after(const Vector& state) const {
  Vector result = matrix.size() == 0 ? state : Vector(matrix * state);
  if (offset.size() != 0) result += offset;
  for (const Quantizer& quantizer : quantizers) result += quantizer.gain * quantizer.reading(state);
  return result;
}

Matrix Reset::slope(Eigen::Index size) const {
  return matrix.size() == 0 ? Matrix(Matrix::Identity(size, size)) : matrix;
}

std::vector<std::string> faults(const HybridSystem& system) { return Inspection(system).faults(); }

}  // namespace gearlash::hybrid
