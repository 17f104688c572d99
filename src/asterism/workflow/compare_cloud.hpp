// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/io/mesh_scale.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/deviation.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

struct CompareOptions {
  DeviationOptions deviation;
  CompletenessOptions completeness;
  int samples = 20000;  // of the surface, that completeness is judged by
};
void describe(CompareOptions& options, OptionVisitor& visit);

/// What a user asks for: any cloud against any surface, both in one frame.
struct CompareJob {
  std::filesystem::path cloud;
  std::string cell;            // whose part is the surface; or
  std::filesystem::path mesh;  // the surface itself
  MeshScale mesh_scale;
  std::optional<LengthUnit> unit;  // of the cloud; none: mm, unless its size says otherwise
  bool without_normals = false;    // the cloud's are passed over
  std::filesystem::path out;       // the cloud in mm with `deviation_mm`; empty: none
  std::filesystem::path report;    // a page; empty: none
  std::uint64_t seed = 1;
  CompareOptions options;
};

struct ComparedCloud {
  std::string part;
  std::size_t points = 0, not_finite = 0;  // read; left out
  TriangleMesh surface;
  std::vector<SurfaceSample> samples;
  Completeness completeness;
  Deviation deviation;
  Cloud cloud;  // kept where it is to be written, else empty: then memory does not grow with the file
  std::vector<std::string> remarks;
};

/// Throws InputError for what cannot be read, no surface or two, an empty cloud, a cloud of another unit or
/// in another place than the surface, and one whose normals face against the surface's.
[[nodiscard]] ComparedCloud compare_cloud(const CompareJob& job, const Progress& progress);

[[nodiscard]] nlohmann::ordered_json summary_of(const ComparedCloud& compared, const CompareJob& job);

}  // namespace asterism
