// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/geometry/triangle_mesh.hpp"

namespace asterism {

/// A surface as a page draws it, with a value at each vertex or none at all.
struct DisplayMesh {
  TriangleMesh surface;
  std::vector<double> value;  // by vertex; empty = none
  double cell_mm = 0;         // vertices nearer than this became one; 0 = the surface is whole
};

/// The surface with at most `most` triangles, for drawing only: vertices in one cell of a grid that face the
/// same way become one at their mean, with the largest of their values (NaN: none), so that a maximum stays
/// on the map. Rossignac and Borrel, "Multi-resolution 3D approximations" (1993). A surface that is small
/// enough stays as it is.
[[nodiscard]] DisplayMesh thinned(const TriangleMesh& surface, const std::vector<double>& value,
                                  std::size_t most);

}  // namespace asterism
