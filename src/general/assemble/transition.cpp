#include <utility>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {

hybrid::Transition transition(std::string name, const hybrid::AffineForm& guard,
                              hybrid::Direction direction, std::size_t target) {
  hybrid::Transition result;
  result.name = std::move(name);
  result.guard = guard;
  result.direction = direction;
  result.target = target;
  return result;
}

void add_branches(const DriveForms& forms, const DriveMode& mode, Branch DriveMode::*automaton,
                  const BranchEdge& begins, const BranchEdge& ends,
                  const std::array<const char*, 3>& names, hybrid::AffineMode& built) {
  const auto to = [&](Branch branch) {
    return forms.modes().index_of(with(mode, automaton, branch));
  };
  if (const double from = sign_of(mode.*automaton); from != 0.0) {
    built.transitions.push_back(
        transition(names[2], ends.form - from * ends.size, falling_on(from), to(Branch::inner)));
    return;
  }
  for (const double way : {1.0, -1.0}) {
    built.transitions.push_back(transition(way > 0.0 ? names[0] : names[1],
                                           begins.form - way * begins.size, rising_on(way),
                                           to(branch_of(way))));
  }
}

hybrid::AffineReset stopped(const DriveForms& forms, std::initializer_list<Eigen::Index> speeds) {
  hybrid::AffineReset reset;
  reset.matrix = forms.identity();
  for (const Eigen::Index speed : speeds) reset.matrix(speed, speed) = 0.0;
  return reset;
}

}  // namespace gearlash::drive
