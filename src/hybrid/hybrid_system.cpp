#include "hybrid/hybrid_system.hpp"

#include <cmath>

#include "base/range_check.hpp"

namespace gearlash::hybrid {
namespace {

/// Collects faults with their places.
class Inspection {
 public:
  explicit Inspection(const HybridSystem& system) : system_(system), size_(system.size()) {}

  std::vector<Fault> of_system() {
    if (size_ == 0) note("state_names", "", "must name at least one number");
    if (system_.mode_count() == 0) note("modes", "", "must be at least one");
    if (system_.source && !system_.modes.empty()) {
      note("modes", counted(system_.modes.size(), "mode"), "must be none, as there is a source");
    }
    const std::size_t told = system_.exogenous.size();
    if (told != 0 && told != system_.state_names.size()) {
      note("exogenous", counted(told, "number"), must_be_numbers());
    }
    for (const Clock& clock : system_.clocks) inspect(clock);
    for (const AffineMode& mode : system_.modes) inspect(mode);
    return std::move(faults_);
  }

  std::vector<Fault> of_mode(std::size_t index) {
    inspect(system_.mode(index));
    return std::move(faults_);
  }

 private:
  void note(const std::string& field, const std::string& value, const std::string& permitted) {
    faults_.push_back({field, value, permitted});
  }

  static std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  }

  std::string must_be_numbers() const {
    return "must be " + counted(static_cast<std::size_t>(size_), "number");
  }

  void expect_vector(const std::string& where, const Vector& vector, bool may_be_empty) {
    if (may_be_empty && vector.size() == 0) return;
    if (vector.size() != size_) {
      note(where, counted(static_cast<std::size_t>(vector.size()), "number"), must_be_numbers());
    } else if (!vector.allFinite()) {
      note(where, "not finite", "must be finite");
    }
  }

  void expect_matrix(const std::string& where, const Matrix& matrix, bool may_be_empty) {
    if (may_be_empty && matrix.size() == 0) return;
    const auto shape = [](Eigen::Index rows, Eigen::Index columns) {
      return std::to_string(rows) + " by " + std::to_string(columns);
    };
    if (matrix.rows() != size_ || matrix.cols() != size_) {
      note(where, shape(matrix.rows(), matrix.cols()), "must be " + shape(size_, size_));
    } else if (!matrix.allFinite()) {
      note(where, "not finite", "must be finite");
    }
  }

  void expect_mode(const std::string& where, std::size_t target) {
    if (target < system_.mode_count()) return;
    note(where, std::to_string(target),
         "must be one of " + counted(system_.mode_count(), "mode") + ", from 0 on");
  }

  void inspect(const std::string& where, const AffineForm& form) {
    expect_vector(where + ".normal", form.normal, false);
    if (!std::isfinite(form.offset)) note(where + ".offset", "not finite", "must be finite");
  }

  void inspect(const std::string& where, const std::vector<Alternative>& alternatives) {
    for (const Alternative& alternative : alternatives) {
      for (const AffineForm& form : alternative.positive) inspect(where + ".positive", form);
      expect_mode(where + ".target", alternative.target);
    }
  }

  void inspect(const std::string& where, const AffineReset& reset) {
    expect_matrix(where + ".matrix", reset.matrix, true);
    expect_vector(where + ".offset", reset.offset, true);
    for (const Quantizer& quantizer : reset.quantizers) {
      inspect(where + ".quantizer.measured", quantizer.measured);
      expect_vector(where + ".quantizer.gain", quantizer.gain, false);
      if (!(quantizer.step > 0.0 && std::isfinite(quantizer.step))) {
        note(where + ".quantizer.step", exact_text(quantizer.step), "must be positive and finite");
      }
    }
  }

  void inspect(const Clock& clock) {
    const std::string where = "clock \"" + clock.name + "\"";
    if (!std::isfinite(clock.first)) note(where + ".first", "not finite", "must be finite");
    if (!std::isfinite(clock.period) || clock.period < 0.0) {
      note(where + ".period", exact_text(clock.period), "must be finite and at least 0");
    }
    if (clock.every == 0) note(where + ".every", "0", "must be at least 1");
    if (clock.period == 0.0 && clock.times.empty()) {
      note(where + ".period", "0", "must be positive where there are no times");
    }
    if (clock.period > 0.0 && !clock.times.empty()) {
      note(where + ".times", counted(clock.times.size(), "time"),
           "must be none where there is a period");
    }
    for (std::size_t i = 0; i < clock.times.size(); ++i) {
      const bool rises = i == 0 || clock.times[i] > clock.times[i - 1];
      if (std::isfinite(clock.times[i]) && rises) continue;
      note(where + ".times[" + std::to_string(i) + "]", exact_text(clock.times[i]),
           "must be finite and above the one before");
    }
    if (!clock.additions.empty() && clock.additions.size() != clock.times.size()) {
      note(where + ".additions", std::to_string(clock.additions.size()),
           "must be as many as there are times, or none");
    }
    for (const Vector& addition : clock.additions) {
      expect_vector(where + ".additions", addition, false);
    }
  }

  template <class Jump>
  void inspect_jump(const std::string& where, const Jump& jump) {
    inspect(where + ".reset", jump.reset);
    expect_mode(where + ".target", jump.target);
    inspect(where + ".alternatives", jump.alternatives);
  }

  void inspect(const std::string& where, const Transition& transition) {
    inspect(where + ".guard", transition.guard);
    inspect_jump(where, transition);
    if (transition.settling) inspect_jump(where + ".settling", *transition.settling);
  }

  void inspect(const std::string& where, const TimedTransition& transition) {
    inspect_jump(where, transition);
    if (transition.clock < system_.clocks.size()) return;
    note(where + ".clock", std::to_string(transition.clock),
         "must be one of " + counted(system_.clocks.size(), "clock") + ", from 0 on");
  }

  void inspect(const AffineMode& mode) {
    const std::string where = "mode \"" + mode.name + "\"";
    expect_matrix(where + ".flow.matrix", mode.flow.matrix, false);
    expect_vector(where + ".flow.offset", mode.flow.offset, false);
    for (const Transition& transition : mode.transitions) {
      inspect(where + ", transition \"" + transition.name + "\"", transition);
    }
    for (const TimedTransition& transition : mode.timed) {
      inspect(where + ", timed transition \"" + transition.name + "\"", transition);
    }
  }

  const HybridSystem& system_;
  Eigen::Index size_;
  std::vector<Fault> faults_;
};

}  // namespace

double largest_entry(const Vector& vector) {
  return vector.size() == 0 ? 0.0 : vector.cwiseAbs().maxCoeff();
}

double Quantizer::reading(const Vector& state) const {
  return step * std::round(measured.at(state) / step);
}

Vector AffineReset::after(const Vector& state) const {
  Vector result = matrix.size() == 0 ? state : Vector(matrix * state);
  if (offset.size() != 0) result += offset;
  for (const Quantizer& quantizer : quantizers) result += quantizer.gain * quantizer.reading(state);
  return result;
}

Matrix AffineReset::slope(Eigen::Index size) const {
  return matrix.size() == 0 ? Matrix(Matrix::Identity(size, size)) : matrix;
}

std::vector<Fault> faults(const HybridSystem& system) { return Inspection(system).of_system(); }

std::vector<Fault> faults_of_mode(const HybridSystem& system, std::size_t index) {
  return Inspection(system).of_mode(index);
}

}  // namespace gearlash::hybrid
