#include <unsupported/Eigen/MatrixFunctions>

#include "numeric/linear_algebra.hpp"

namespace gearlash {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) { return matrix.exp(); }

}  // namespace gearlash
