#include "hybrid/preparation.hpp"

#include <cmath>

#include "base/lists.hpp"

namespace gearlash::hybrid {
namespace {

std::vector<SparseForm> guards_of(const AffineMode& mode) {
  return of_each<SparseForm>(mode.transitions, &Transition::guard);
}

/// Whether events change a number not at all; or by constants, if it `may_step`.
bool is_left_alone(const AffineReset& reset, Eigen::Index number, Eigen::Index size,
                   bool may_step) {
  const bool by_matrix = reset.matrix.size() != 0 &&
                         reset.matrix.row(number) != Vector::Unit(size, number).transpose();
  const bool by_offset = reset.offset.size() != 0 && reset.offset[number] != 0.0;
  return !by_matrix && (may_step || !by_offset) &&
         all_of(reset.quantizers,
                [&](const Quantizer& quantizer) { return quantizer.gain[number] == 0.0; });
}

bool is_left_alone(const AffineMode& mode, Eigen::Index number, Eigen::Index size, bool may_step) {
  bool is_left = true;
  for_each_jump(mode, [&](const auto& jump) {
    is_left = is_left && is_left_alone(jump.reset, number, size, may_step);
  });
  return is_left;
}

/// Whether all modes have the same flow of a number, none if it is a count, and events leave it
/// alone.
bool has_own_flow(const HybridSystem& system, Eigen::Index number, bool is_count) {
  const AffineFlow& first = system.modes.front().flow;
  if (is_count && !(first.matrix.row(number).isZero(0.0) && first.offset[number] == 0.0)) {
    return false;
  }
  return all_of(system.modes, [&](const AffineMode& mode) {
    return mode.flow.matrix.row(number) == first.matrix.row(number) &&
           mode.flow.offset[number] == first.offset[number] &&
           is_left_alone(mode, number, system.size(), is_count);
  });
}

/// Numbers that follow their own flow alone, the same in every mode, and that no event changes; and
/// counts, which no flow moves and events change by constants.
std::vector<bool> exogenous_numbers(const HybridSystem& system) {
  const auto size = static_cast<std::size_t>(system.size());
  if (system.source) {
    return system.exogenous.empty() ? std::vector<bool>(size, false) : system.exogenous;
  }
  const Matrix& flow = system.modes.front().flow.matrix;
  std::vector<bool> is(size);
  for (std::size_t n = 0; n < size; ++n) {
    is[n] = has_own_flow(system, static_cast<Eigen::Index>(n), false);
  }
  for (bool changed = true; changed;) {  // excludes numbers on which excluded ones act
    changed = false;
    for (std::size_t n = 0; n < size; ++n) {
      for (std::size_t k = 0; is[n] && k < size; ++k) {
        if (is[k] || flow(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) == 0.0) {
          continue;
        }
        is[n] = false;
        changed = true;
      }
    }
  }
  for (std::size_t n = 0; n < size; ++n) {
    is[n] = is[n] || has_own_flow(system, static_cast<Eigen::Index>(n), true);
  }
  return is;
}

}  // namespace

PreparedReset::PreparedReset(const AffineReset& reset, Eigen::Index size) {
  for (Eigen::Index i = 0; i < size; ++i) {
    AffineForm row{reset.matrix.size() == 0 ? Vector(Vector::Unit(size, i))
                                            : Vector(reset.matrix.row(i).transpose()),
                   reset.offset.size() == 0 ? 0.0 : reset.offset[i]};
    if (row.offset == 0.0 && row.normal == Vector::Unit(size, i)) continue;
    rows.push_back({static_cast<int>(i), SparseForm(row)});
  }
}

void PreparedReset::apply(const AffineReset& reset, const Vector& before, Vector& after,
                          Vector& noise, Vector& scratch) const {
  scratch = noise;
  for (const auto& [number, form] : rows) {
    after[number] = form.at(before.data());
    double unknown = 0.0;
    for (const auto& [from, factor] : form.terms) unknown += std::abs(factor) * scratch[from];
    noise[number] = unknown;
  }
  for (const Quantizer& quantizer : reset.quantizers) {
    after += quantizer.gain * quantizer.reading(before);
  }
}

PreparedFlow::PreparedFlow(const AffineFlow& affine, const std::vector<SparseForm>& forms)
    : flow(affine) {
  guards.reserve(forms.size());
  for (const SparseForm& form : forms) guards.emplace_back(flow, form);
  if (flow.count() > 0 && flow.polynomial_order() == 0) longest.emplace(flow, flow.longest_step());
}

PreparedJump::PreparedJump(const AffineReset& all, const std::vector<Alternative>& others,
                           Eigen::Index size)
    : reset(all, size) {
  for (const Alternative& other : others) {
    alternatives.push_back({{}, other.target});
    for (const AffineForm& form : other.positive) {
      alternatives.back().positive.emplace_back(form);
    }
  }
}

PreparedMode::PreparedMode(const AffineMode& mode, Eigen::Index size)
    : guards(guards_of(mode)), whole(mode.flow, guards), mode_(&mode), affine_(mode.flow) {
  transitions.reserve(mode.transitions.size());
  settlings.reserve(mode.transitions.size());
  for (const Transition& transition : mode.transitions) {
    transitions.emplace_back(transition, size);
    settlings.emplace_back();
    if (transition.settling) settlings.back().emplace(*transition.settling, size);
  }
  timed.reserve(mode.timed.size());
  for (const TimedTransition& tick : mode.timed) timed.emplace_back(tick, size);
}

const std::vector<PreparedMode::Slow>& PreparedMode::slow() const {
  std::call_once(once_, [this] {
    for (FastDecays& decays : fast_decays(affine_)) {
      PreparedFlow flow(decays.slow, guards);
      slow_.push_back({std::move(decays), std::move(flow)});
    }
  });
  return slow_;
}

const PreparedMode& Preparation::mode(std::size_t index) const {
  Slot& slot = slots_[index];
  std::call_once(slot.once, [&] {
    if (system_->source) require_none(faults_of_mode(*system_, index));
    slot.mode = std::make_unique<const PreparedMode>(system_->mode(index), system_->size());
  });
  return *slot.mode;
}

const std::vector<bool>& Preparation::exogenous() const {
  std::call_once(exogenous_once_, [this] { exogenous_ = exogenous_numbers(*system_); });
  return exogenous_;
}

}  // namespace gearlash::hybrid
