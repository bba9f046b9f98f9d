// A program with an Eigen of its own, beside the library's: memory of one must not meet the other.
#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <gearlash/gearlash.hpp>

#ifdef Eigen
#error "the library's name for its Eigen has reached its users"
#endif

int main() {
  using namespace gearlash;
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  drive.contact = CompliantContact{.stiffness = 1e4, .damping = 1e3};  // of the general engine
  const Answer answer = analyse(drive);
  Eigen::MatrixXd amplitudes(7, 7);
  for (const Cycle& cycle : answer.cycles) amplitudes.setConstant(cycle.amplitude);
  const Eigen::MatrixXd squares = amplitudes * amplitudes;
  std::printf("%s, %.6f\n", name_of(answer.verdict), std::sqrt(squares.trace()) / 7.0);
  return squares.allFinite() ? 0 : 1;
}
