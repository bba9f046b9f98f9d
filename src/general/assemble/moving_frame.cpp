#include "general/assemble/moving_frame.hpp"

#include <limits>
#include <utility>

#include "base/lists.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::AffineReset;
using hybrid::Vector;

class Rewriter {
 public:
  explicit Rewriter(MovingFrame frame) : frame_(std::move(frame)) {}

  void rewrite(hybrid::Clock& clock) const {
    for (Vector& addition : clock.additions) addition = divided(addition);
  }

  void rewrite(hybrid::AffineMode& mode) const {
    hybrid::AffineFlow& flow = mode.flow;
    flow.offset = divided(flow.matrix * frame_.shift + flow.offset - frame_.drift);
    flow.matrix = similar(flow.matrix);
    for (hybrid::Transition& transition : mode.transitions) rewrite(transition.guard);
    for_each_jump(mode, [this](auto& jump) {
      rewrite(jump.reset);
      rewrite(jump.alternatives);
    });
  }

 private:
  Vector divided(const Vector& numbers) const { return numbers.cwiseQuotient(frame_.scale); }

  hybrid::Matrix similar(const hybrid::Matrix& matrix) const {
    return frame_.scale.cwiseInverse().asDiagonal() * matrix * frame_.scale.asDiagonal();
  }

  void rewrite(AffineForm& form) const { form = frame_.inside(std::move(form)); }

  void rewrite(std::vector<hybrid::Alternative>& alternatives) const {
    for (hybrid::Alternative& alternative : alternatives) {
      for (AffineForm& form : alternative.positive) rewrite(form);
    }
  }

  void rewrite(AffineReset& reset) const {
    Vector offset =
        reset.offset.size() == 0 ? Vector(Vector::Zero(frame_.shift.size())) : reset.offset;
    if (reset.matrix.size() != 0) {
      offset += reset.matrix * frame_.shift - frame_.shift;
      reset.matrix = similar(reset.matrix);
    }
    reset.offset = divided(offset);
    for (hybrid::Quantizer& quantizer : reset.quantizers) {
      rewrite(quantizer.measured);
      quantizer.gain = divided(quantizer.gain);
    }
  }

  MovingFrame frame_;
};

constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();

/// Whether each row's product with a vector is 0 within rounding.
bool is_nothing(const hybrid::Matrix& matrix, const Vector& way) {
  const Vector terms = matrix.cwiseAbs() * way.cwiseAbs();
  return ((matrix * way).array().abs() <= rounding * terms.array()).all();
}

bool is_unseen(const AffineForm& form, const Vector& way) {
  return is_nothing(form.normal.transpose(), way);
}

bool is_unseen(const std::vector<hybrid::Alternative>& alternatives, const Vector& way) {
  return all_of(alternatives, [&](const auto& alternative) {
    return all_of(alternative.positive,
                  [&](const AffineForm& form) { return is_unseen(form, way); });
  });
}

bool is_kept(const AffineReset& reset, const Vector& way) {
  if (!reset.quantizers.empty()) return false;
  if (reset.matrix.size() == 0) return true;
  const Vector terms = reset.matrix.cwiseAbs() * way.cwiseAbs() + way.cwiseAbs();
  return ((reset.matrix * way - way).array().abs() <= rounding * terms.array()).all();
}

bool leaves_mode_unchanged(const hybrid::AffineMode& mode, const Vector& way) {
  bool leaves = is_nothing(mode.flow.matrix, way);
  for (const hybrid::Transition& transition : mode.transitions) {
    leaves = leaves && is_unseen(transition.guard, way);
  }
  for_each_jump(mode, [&](const auto& jump) {
    leaves = leaves && is_kept(jump.reset, way) && is_unseen(jump.alternatives, way);
  });
  return leaves;
}

}  // namespace

Vector MovingFrame::inside(const Vector& numbers, double time) const {
  return (numbers - shift - drift * time).cwiseQuotient(scale);
}

Vector MovingFrame::outside(const Vector& numbers, double time) const {
  return scale.cwiseProduct(numbers) + shift + drift * time;
}

AffineForm MovingFrame::inside(AffineForm form) const {
  form.offset += form.normal.dot(shift);
  form.normal = form.normal.cwiseProduct(scale);
  return form;
}

bool is_carried_along(const hybrid::HybridSystem& system, const Vector& way) {
  for (std::size_t i = 0; i < system.mode_count(); ++i) {
    if (!leaves_mode_unchanged(system.mode(i), way)) return false;
  }
  return true;
}

hybrid::HybridSystem seen_in(const hybrid::HybridSystem& system, const MovingFrame& frame) {
  const Rewriter rewriter(frame);
  hybrid::HybridSystem result = system;
  for (hybrid::Clock& clock : result.clocks) rewriter.rewrite(clock);
  for (hybrid::AffineMode& mode : result.modes) rewriter.rewrite(mode);
  if (!system.source) return result;
  result.source =
      hybrid::ModeSource(system.mode_count(), [from = system.source, rewriter](std::size_t index) {
        hybrid::AffineMode mode = from.mode(index);
        rewriter.rewrite(mode);
        return mode;
      });
  return result;
}

hybrid::PeriodicOrbit unscaled(hybrid::PeriodicOrbit orbit, const Vector& scale) {
  orbit.start.numbers = orbit.start.numbers.cwiseProduct(scale);
  for (hybrid::Event& event : orbit.events) {
    event.before = event.before.cwiseProduct(scale);
    event.after = event.after.cwiseProduct(scale);
  }
  return orbit;
}

}  // namespace gearlash::drive
