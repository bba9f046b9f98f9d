#include "model/normalized_servo.hpp"

#include <cmath>

#include "base/range_check.hpp"

namespace gearlash {
namespace {

/// Permitted values of a number: from least to most, and 0 where permitted.
struct Range {
  double least;
  double most;
  bool or_zero = false;

  bool includes(double value) const {
    return (value >= least && value <= most) || (or_zero && value == 0.0);
  }
  std::string text() const {
    return std::string(or_zero ? "0 or " : "") + "from " + exact_text(least) + " to " +
           exact_text(most);
  }
};

constexpr Range damping_range{1e-15, 1e3, true};
constexpr Range inertia_ratio_range{1e-9, 1e9};
constexpr Range share_range{0.0, 1.0};
constexpr Range backlash_range{1e-15, 1e6, true};

bool permitted_inertia_ratio(double ratio) {
  return ratio == 0.0 || inertia_ratio_range.includes(ratio) || (std::isinf(ratio) && ratio > 0.0);
}

}  // namespace

std::string permitted_values(std::string_view field) {
  if (field == "damping") return damping_range.text();
  if (field == "inertia_ratio") {
    return "0 (massless load), " + inertia_ratio_range.text() + ", or inf (massless motor)";
  }
  if (field == "friction_ratio" || field == "restitution") return share_range.text();
  if (field == "backlash") return backlash_range.text() + " (rad)";
  return "";
}

std::vector<Fault> faults(const NormalizedServo& servo) {
  RangeCheck check;
  const auto require = [&](bool permitted, const char* field, double value) {
    if (!permitted) check.refuse(field, exact_text(value), "must be " + permitted_values(field));
  };
  require(damping_range.includes(servo.damping), "damping", servo.damping);
  require(permitted_inertia_ratio(servo.inertia_ratio), "inertia_ratio", servo.inertia_ratio);
  require(share_range.includes(servo.friction_ratio), "friction_ratio", servo.friction_ratio);
  require(backlash_range.includes(servo.backlash), "backlash", servo.backlash);
  require(share_range.includes(servo.restitution), "restitution", servo.restitution);
  const double load_friction = servo.damping * servo.friction_ratio;
  const double motor_friction = servo.damping * (1.0 - servo.friction_ratio);
  if (servo.inertia_ratio == 0.0 && load_friction == 0.0) {
    check.refuse("inertia_ratio", "0",
                 "must be positive if the load has no friction (damping * friction_ratio = 0): "
                 "a shaft needs inertia or friction");
  }
  if (std::isinf(servo.inertia_ratio) && motor_friction == 0.0) {
    check.refuse("inertia_ratio", "inf",
                 "must be finite if the motor has no friction (damping * (1 - friction_ratio) "
                 "= 0): a shaft needs inertia or friction");
  }
  return check.faults();
}

}  // namespace gearlash
