// Prepares a system's modes for simulation, each when it is first entered.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "hybrid/fast_decays.hpp"
#include "hybrid/guard_form.hpp"

namespace gearlash::hybrid {

/// A reset by those rows in which it is not the identity.
struct PreparedReset {
  struct Row {
    int number;
    SparseForm form;
  };
  std::vector<Row> rows;

  PreparedReset(const Reset& reset, Eigen::Index size);
  /// Takes numbers and their uncertainty before. `noise` does not include rounding added here.
  void apply(const Reset& reset, const Vector& before, Vector& after, Vector& noise,
             Vector& scratch) const;
};

/// A flow with its guards as polynomials.
struct PreparedFlow {
  LinearFlow flow;
  std::vector<GuardTable> guards;
  std::optional<Stride> longest;  ///< if steps have a longest length

  PreparedFlow(const AffineFlow& affine, const std::vector<SparseForm>& guards);
};

/// Firings lead to the first alternative whose forms are all positive.
struct PreparedAlternative {
  std::vector<SparseForm> positive;
  std::size_t target;
};

struct PreparedJump {
  PreparedReset reset;
  std::vector<PreparedAlternative> alternatives;

  PreparedJump(const Reset& reset, const std::vector<Alternative>& alternatives, Eigen::Index size);
};

class PreparedMode {
 public:
  /// The mode must live for as long as motions enter it.
  PreparedMode(const Mode& mode, Eigen::Index size);

  const Mode& mode() const { return *mode_; }

  struct Slow {
    FastDecays decays;
    PreparedFlow flow;
  };
  /// Without its fast decays; null if there are none. Computed when first requested.
  const Slow* slow() const;

  std::vector<SparseForm> guards;
  PreparedFlow whole;
  std::vector<PreparedJump> transitions;
  std::vector<std::optional<PreparedJump>> settlings;  ///< by transition
  std::vector<PreparedJump> timed;

 private:
  const Mode* mode_;
  AffineFlow affine_;
  mutable std::once_flag once_;
  mutable std::optional<Slow> slow_;
};

/// Several threads may use it.
class Preparation {
 public:
  /// The system must live for as long as modes are entered.
  explicit Preparation(const HybridSystem& system)
      : system_(&system), slots_(system.mode_count()) {}
  /// With its own copy.
  explicit Preparation(HybridSystem&& system)
      : own_(std::make_unique<const HybridSystem>(std::move(system))),
        system_(own_.get()),
        slots_(own_->mode_count()) {}

  const HybridSystem& system() const { return *system_; }
  /// Throws InvalidInput with all faults of a mode that a source has made.
  const PreparedMode& mode(std::size_t index) const;
  /// The numbers that follow their own flow alone in every mode, and that no event changes.
  const std::vector<bool>& exogenous() const;

 private:
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const PreparedMode> mode;
  };
  std::unique_ptr<const HybridSystem> own_;
  const HybridSystem* system_;
  mutable std::vector<Slot> slots_;
  mutable std::once_flag exogenous_once_;
  mutable std::vector<bool> exogenous_;
};

}  // namespace gearlash::hybrid
