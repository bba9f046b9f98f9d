#include "analysis/ceiling/closed_gap.hpp"

#include <algorithm>
#include <variant>
#include <vector>

namespace gearlash {
namespace {

bool knows_error_alone(const drive::LinearController& controller) {
  const auto is_difference = [](const std::vector<double>& row) { return row[0] == -row[1]; };
  return is_difference(controller.direct) &&
         std::all_of(controller.input_matrix.begin(), controller.input_matrix.end(), is_difference);
}

}  // namespace

bool follows_reference(const drive::ReducedDrive& drive) {
  const auto* constant = std::get_if<double>(&drive.reference);
  if (constant != nullptr && *constant == 0.0) return true;
  return knows_error_alone(drive.sampling
                               ? drive::sampled_controller(drive.controller, *drive.sampling)
                               : drive::linear_controller(drive.controller));
}

}  // namespace gearlash
