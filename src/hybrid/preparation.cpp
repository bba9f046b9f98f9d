#include "hybrid/preparation.hpp"

#include <cmath>

namespace gearlash::hybrid {
namespace {

std::vector<SparseForm> guards_of(const Mode& mode) {
  std::vector<SparseForm> guards;
  guards.reserve(mode.transitions.size());
  for (const Transition& transition : mode.transitions) guards.emplace_back(transition.guard);
  return guards;
}

}  // namespace

PreparedReset::PreparedReset(const Reset& reset, Eigen::Index size) {
  for (Eigen::Index i = 0; i < size; ++i) {
    AffineForm row{reset.matrix.size() == 0 ? Vector(Vector::Unit(size, i))
                                            : Vector(reset.matrix.row(i).transpose()),
                   reset.offset.size() == 0 ? 0.0 : reset.offset[i]};
    if (row.offset == 0.0 && row.normal == Vector::Unit(size, i)) continue;
    rows.push_back({static_cast<int>(i), SparseForm(row)});
  }
}

void PreparedReset::apply(const Reset& reset, const Vector& before, Vector& after, Vector& noise,
                          Vector& scratch) const {
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

PreparedJump::PreparedJump(const Reset& all, const std::vector<Alternative>& others,
                           Eigen::Index size)
    : reset(all, size) {
  for (const Alternative& other : others) {
    alternatives.push_back({{}, other.target});
    for (const AffineForm& form : other.positive) {
      alternatives.back().positive.emplace_back(form);
    }
  }
}

PreparedMode::PreparedMode(const Mode& mode, Eigen::Index size)
    : guards(guards_of(mode)), whole(mode.flow, guards), affine_(mode.flow) {
  transitions.reserve(mode.transitions.size());
  settlings.reserve(mode.transitions.size());
  for (const Transition& transition : mode.transitions) {
    transitions.emplace_back(transition.reset, transition.alternatives, size);
    settlings.emplace_back();
    if (!transition.settling) continue;
    settlings.back().emplace(transition.settling->reset, transition.settling->alternatives, size);
  }
  timed.reserve(mode.timed.size());
  for (const TimedTransition& tick : mode.timed) {
    timed.emplace_back(tick.reset, tick.alternatives, size);
  }
}

const PreparedMode::Slow* PreparedMode::slow() const {
  std::call_once(once_, [this] {
    std::optional<FastDecays> decays = fast_decays(affine_);
    if (!decays) return;
    PreparedFlow flow(decays->slow, guards);
    slow_.emplace(Slow{std::move(*decays), std::move(flow)});
  });
  return slow_ ? &*slow_ : nullptr;
}

const PreparedMode& Preparation::mode(std::size_t index) const {
  Slot& slot = slots_[index];
  std::call_once(slot.once, [&] {
    slot.mode = std::make_unique<const PreparedMode>(system_->modes[index], system_->size());
  });
  return *slot.mode;
}

}  // namespace gearlash::hybrid
