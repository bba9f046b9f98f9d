#include "question/change/proved_values.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "question/change/target.hpp"
#include "question/change/value_scan.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/ceiling/enclosed_ceiling.hpp"

namespace gearlash {
namespace {

/// Of a part of the interval.
struct Judged {
  Bounds values{};
  bool is_proved = false;
  bool is_hopeless = false;  ///< no halving helps
  std::string reason{};
};

Judged judged(const Drive& drive, std::string_view path, const Bounds& values,
              const Target& target) {
  Judged part{.values = values};
  const BoxSide side{std::string(path), values};
  const std::variant<EnclosedDrive, std::string> drives = enclosed_drive(drive, {&side, 1});
  if (const auto* reason = std::get_if<std::string>(&drives)) {
    part.reason = *reason;
    part.is_hopeless = true;
    return part;
  }
  Answer bounds;
  bounds.ceiling = ceiling_of(std::get<EnclosedDrive>(drives));
  part.is_proved = all_of(target.limits, [&](const QuantityLimit& limit) {
    const std::optional<double> bound = bounds.value(limit.quantity);
    return bound && *bound <= limit.permitted.high;
  });
  return part;
}

}  // namespace

bool is_provable(const QuantityLimit& limit) {
  const bool is_ceiling = limit.quantity == Quantity::ceiling ||
                          limit.quantity == Quantity::motor_ceiling ||
                          limit.quantity == Quantity::effort_ceiling;
  return is_ceiling && !(limit.permitted.low > 0.0);
}

IntervalProof prove_target(const Drive& drive, std::string_view path, const Bounds& interval,
                           const Target& target, std::size_t most_boxes, Progress& progress) {
  constexpr double least_share = 1e-9;
  const double least = least_share * (interval.high - interval.low);
  IntervalProof proof;
  std::vector<Bounds> open = {interval};
  // Where a parameter is 0, the loop may have another form.
  if (interval.low == 0.0 && judged(drive, path, interval, target).is_hopeless) {
    open.front().low = least;
  }
  while (!open.empty() && proof.evaluations < most_boxes) {
    // The first of them: what is not reached is not proved.
    open.resize(std::min(open.size(), most_boxes - proof.evaluations));
    if (!progress.go_on(static_cast<double>(proof.evaluations) / static_cast<double>(most_boxes))) {
      break;
    }
    const std::vector<Judged> parts = of_each_on_threads(
        open, [&](const Bounds& values) { return judged(drive, path, values, target); });
    proof.evaluations += open.size();
    open.clear();
    for (const Judged& part : parts) {
      if (part.is_proved) {
        ++proof.boxes;
        proof.parts.push_back(part.values);
      } else if (part.is_hopeless) {
        proof.reason = part.reason;
        return proof;
      } else if (part.values.high - part.values.low > least) {
        const double middle = middle_of(part.values);
        open.push_back({part.values.low, middle});
        open.push_back({middle, part.values.high});
      }
    }
  }
  sort_by(proof.parts, &Bounds::low);
  for (const Bounds& part : std::exchange(proof.parts, {})) add(proof.parts, part);
  if (proof.parts.empty()) proof.reason = "interval bounds of no part of it keep the limit";
  return proof;
}

}  // namespace gearlash
