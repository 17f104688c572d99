// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asterism/geometry/types.hpp"

namespace asterism {

/// A number at each point: `sigma_mm`; in a PLY file it is called `scalar_sigma_mm`.
struct CloudField {
  std::string name;
  std::vector<double> values;
};

/// Points in one frame with whatever is known of each.
struct Cloud {
  std::vector<Vec3> points;    // mm
  std::vector<Vec3f> normals;  // unit; one a point, or none at all
  std::vector<CloudField> fields;

  [[nodiscard]] std::size_t size() const { return points.size(); }
  /// Null when there is none of that name.
  [[nodiscard]] const std::vector<double>* field(std::string_view name) const {
    for (const CloudField& each : fields) {
      if (each.name == name) return &each.values;
    }
    return nullptr;
  }
};

}  // namespace asterism
