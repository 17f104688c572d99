// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/mesh_file.hpp"

#include <algorithm>
#include <cctype>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/mesh_formats.hpp"

namespace asterism {

TriangleMesh read_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  using Reader = TriangleMesh (*)(std::string_view, const std::filesystem::path&);
  const Reader reader = ending == ".stl"   ? mesh_of_stl
                        : ending == ".obj" ? mesh_of_obj
                        : ending == ".off" ? mesh_of_off
                        : ending == ".ply" ? mesh_of_ply
                                           : nullptr;
  if (reader == nullptr) {
    throw InputError(file.string(), "is no mesh by its name; readable are: .stl, .obj, .off, .ply");
  }
  TriangleMesh mesh = welded(reader(read_file(file), file));
  if (mesh.empty()) throw InputError(file.string(), "holds no triangles");
  return mesh;
}

}  // namespace asterism
