#include "hybrid/system_slopes.hpp"

#include <algorithm>

namespace gearlash::hybrid {
namespace {

AffineFlow map_of(const AffineReset& reset, Eigen::Index size) {
  return {reset.slope(size), reset.offset.size() == 0 ? Vector(Vector::Zero(size)) : reset.offset};
}

void add(AffineFlow& sum, const AffineFlow& term, double weight) {
  sum.matrix += weight * term.matrix;
  sum.offset += weight * term.offset;
}

void add(ModeSlopes& sum, const AffineMode& mode, double weight) {
  const Eigen::Index size = sum.flow.offset.size();
  add(sum.flow, mode.flow, weight);
  for (std::size_t k = 0; k < mode.transitions.size(); ++k) {
    const Transition& transition = mode.transitions[k];
    sum.guards[k].normal += weight * transition.guard.normal;
    sum.guards[k].offset += weight * transition.guard.offset;
    add(sum.resets[k], map_of(transition.reset, size), weight);
    if (transition.settling)
      add(sum.settlings[k], map_of(transition.settling->reset, size), weight);
  }
}

bool has_quantizers(const AffineMode& mode) {
  return std::any_of(mode.transitions.begin(), mode.transitions.end(), [](const Transition& one) {
    return !one.reset.quantizers.empty() ||
           (one.settling && !one.settling->reset.quantizers.empty());
  });
}

bool have_one_shape(const AffineMode& a, const AffineMode& b) {
  return std::equal(a.transitions.begin(), a.transitions.end(), b.transitions.begin(),
                    b.transitions.end(), [](const Transition& one, const Transition& other) {
                      return one.settling.has_value() == other.settling.has_value();
                    });
}

ModeSlopes zero_slopes(const AffineMode& mode) {
  const Eigen::Index size = mode.flow.offset.size();
  const AffineFlow zero{Matrix::Zero(size, size), Vector::Zero(size)};
  const std::size_t count = mode.transitions.size();
  return {zero, {count, {Vector::Zero(size), 0.0}}, {count, zero}, {count, zero}};
}

}  // namespace

SystemSlopes::SystemSlopes(const Family& family, double parameter, double step) : step_(step) {
  for (std::size_t k = 0; k < pairs; ++k) {
    const double distance = static_cast<double>(k + 1) * step;
    above_[k] = family(parameter + distance);
    below_[k] = family(parameter - distance);
  }
}

const ModeSlopes* SystemSlopes::mode(std::size_t index) const {
  auto found = modes_.find(index);
  if (found == modes_.end()) found = modes_.emplace(index, made(index)).first;
  return found->second ? &*found->second : nullptr;
}

std::optional<ModeSlopes> SystemSlopes::made(std::size_t index) const {
  const auto alike = [&](const HybridSystem& system) {
    return system.size() == above_[0].size() && system.mode_count() == above_[0].mode_count() &&
           have_one_shape(system.mode(index), above_[0].mode(index));
  };
  if (index >= above_[0].mode_count() || has_quantizers(above_[0].mode(index)) ||
      !std::all_of(above_.begin(), above_.end(), alike) ||
      !std::all_of(below_.begin(), below_.end(), alike)) {
    return std::nullopt;
  }
  ModeSlopes slopes = zero_slopes(above_[0].mode(index));
  for (std::size_t k = 0; k < pairs; ++k) {
    add(slopes, above_[k].mode(index), difference_weights[k] / step_);
    add(slopes, below_[k].mode(index), -difference_weights[k] / step_);
  }
  return slopes;
}

}  // namespace gearlash::hybrid
