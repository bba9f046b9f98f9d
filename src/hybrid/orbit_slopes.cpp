#include "hybrid/orbit_slopes.hpp"

#include <vector>

#include "base/special_numbers.hpp"
#include "hybrid/disturbances.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

using Index = Eigen::Index;

std::vector<Index> own_numbers(const PreparedSystem& system) {
  std::vector<Index> own;
  const std::vector<bool>& exogenous = system.exogenous();
  for (std::size_t n = 0; n < exogenous.size(); ++n) {
    if (!exogenous[n]) own.push_back(static_cast<Index>(n));
  }
  return own;
}

}  // namespace

std::optional<OrbitSlopes> orbit_slopes(const PreparedSystem& system, const PeriodicOrbit& orbit,
                                        const SystemSlopes& slopes) {
  const HybridSystem& of = system.system();
  Disturbances disturbances(of, orbit.start, 0.0, &slopes);
  for (const Event& event : orbit.events) {
    if (!disturbances.meet(event)) return std::nullopt;
  }
  if (!disturbances.flow_to(orbit.period)) return std::nullopt;
  const Index size = of.size();
  const Vector flow = velocity(of.mode(orbit.start.mode).flow, orbit.start.numbers);
  const std::vector<Index> own = own_numbers(system);
  const auto count = static_cast<Index>(own.size());
  Matrix equations = Matrix::Zero(count + 1, count + 1);
  equations.topLeftCorner(count, count) = disturbances.slope()(own, own);
  equations.topLeftCorner(count, count) -= Matrix::Identity(count, count);
  equations.col(count).head(count) = flow(own);
  equations.row(count).head(count) = flow(own).transpose();
  Vector right = Vector::Zero(count + 1);
  right.head(count) = -disturbances.slope().col(size)(own);
  const Vector solved = solved_with_full_pivoting(equations, right);
  const double mismatch = largest_entry(equations * solved - right);
  constexpr double rounding = 1e-9;
  if (!solved.allFinite() || !(mismatch <= rounding * largest_entry(right))) return std::nullopt;
  OrbitSlopes found{solved[count], Vector::Zero(size)};
  for (Index i = 0; i < count; ++i) found.start[own[static_cast<std::size_t>(i)]] = solved[i];
  return found;
}

double slope_of(const AffineForm& form, double time, const PreparedSystem& system,
                const PeriodicOrbit& orbit, const SystemSlopes& slopes, const OrbitSlopes& along) {
  const HybridSystem& of = system.system();
  Disturbances disturbances(of, orbit.start, 0.0, &slopes);
  Vector all(of.size() + 1);
  all << along.start, 1.0;
  std::size_t mode = orbit.start.mode;
  for (const Event& event : orbit.events) {
    if (event.time > time) break;
    disturbances.flow_to(event.time);
    const double before = form.normal.dot(disturbances.slope() * all);
    const Vector flow = velocity(of.mode(mode).flow, event.before);
    if (!disturbances.meet(event)) return not_a_number;
    if (event.time == time) return before + form.normal.dot(flow) * disturbances.delay().dot(all);
    mode = event.mode_after;
  }
  if (!disturbances.flow_to(time)) return not_a_number;
  return form.normal.dot(disturbances.slope() * all);
}

}  // namespace gearlash::hybrid
