// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "asterism/geometry/types.hpp"

namespace asterism {

/// Of a small motion's information or covariance: eigenvalues ascending, eigenvectors as columns.
struct SymmetricEigen6 {
  Vec6 values;
  Mat6 vectors;
};
[[nodiscard]] SymmetricEigen6 symmetric_eigen6(const Mat6& symmetric);

}  // namespace asterism
