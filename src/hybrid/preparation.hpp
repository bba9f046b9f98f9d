// A system's modes made ready for simulation, each when it is first entered.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "hybrid/fast_decays.hpp"
#include "hybrid/guard_form.hpp"

namespace gearlash::hybrid {

/// A reset, as the rows in which it differs from the identity.
struct PreparedReset {
  struct Row {
    int number;
    SparseForm form;
  };
  std::vector<Row> rows;

  PreparedReset(const AffineReset& reset, Eigen::Index size);
  /// Writes the state after the reset to `after`, and carries `noise`, the numbers' uncertainty,
  /// over. The reset's own rounding is not added to `noise`.
  void apply(const AffineReset& reset, const Vector& before, Vector& after, Vector& noise,
             Vector& scratch) const;
};

/// A flow with its guards as polynomials over a step.
struct PreparedFlow {
  LinearFlow flow;
  std::vector<GuardTable> guards;
  std::optional<Stride> longest;  ///< empty if steps may be arbitrarily long

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

  template <class Jump>
  PreparedJump(const Jump& jump, Eigen::Index size)
      : PreparedJump(jump.reset, jump.alternatives, size) {}
  PreparedJump(const AffineReset& reset, const std::vector<Alternative>& alternatives,
               Eigen::Index size);
};

class PreparedMode {
 public:
  /// The mode must live for as long as motions enter it.
  PreparedMode(const AffineMode& mode, Eigen::Index size);

  const AffineMode& mode() const { return *mode_; }

  struct Slow {
    FastDecays decays;
    PreparedFlow flow;
  };
  /// The flow without its fastest decays, without the next fastest too, and so on. Computed on
  /// first use.
  const std::vector<Slow>& slow() const;

  std::vector<SparseForm> guards;
  PreparedFlow whole;
  std::vector<PreparedJump> transitions;
  std::vector<std::optional<PreparedJump>> settlings;  ///< by transition
  std::vector<PreparedJump> timed;

 private:
  const AffineMode* mode_;
  AffineFlow affine_;
  mutable std::once_flag once_;
  mutable std::vector<Slow> slow_;
};

/// May be used by several threads.
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
  /// Which numbers follow their own flow alone in every mode and are changed by no event; or are
  /// moved by no flow and changed by constants.
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
