#include "hybrid/turns.hpp"

#include <utility>

namespace gearlash::hybrid {

HybridSystem with_turns(
    const HybridSystem& system,
    const std::function<AffineForm(std::size_t index, const AffineMode& mode)>& form_in,
    OtherEvents others) {
  const bool are_kept = others == OtherEvents::kept;
  HybridSystem result = are_kept ? system : HybridSystem{.state_names = system.state_names};
  result.modes.clear();
  result.source = ModeSource(system.mode_count(), [system, form_in, are_kept](std::size_t index) {
    AffineMode mode = system.mode(index);
    AffineForm form = form_in(index, mode);
    if (!are_kept) mode = {.flow = std::move(mode.flow)};
    mode.transitions.push_back({.name = "turns",
                                .guard = std::move(form),
                                .direction = Direction::either,
                                .target = index});
    return mode;
  });
  return result;
}

HybridSystem with_turns(const HybridSystem& system, const AffineForm& form, OtherEvents others) {
  return with_turns(
      system, [form](std::size_t, const AffineMode&) { return form; }, others);
}

AffineForm rate_of(const AffineForm& form, const AffineFlow& flow) {
  return {flow.matrix.transpose() * form.normal, form.normal.dot(flow.offset)};
}

}  // namespace gearlash::hybrid
