// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace asterism {

SymmetricEigen6 symmetric_eigen6(const Mat6& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace asterism
