// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "asterism/core/result.hpp"
#include "asterism/io/alignment_file.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/io/mesh_scale.hpp"
#include "asterism/scanning/alignment.hpp"
#include "asterism/workflow/probed_points.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  ProbedFile probed;
  std::string out, nominal, planes, cell, mesh, mesh_unit;
  double ball_mm = 0, free_mm = 0.5, within_mm = 200;
  std::optional<double> longest_mm;
  bool flip = false;
};

Vec3 place_in(const CsvTable& table, std::size_t row) {
  return {table.number(row, "x_mm"), table.number(row, "y_mm"), table.number(row, "z_mm")};
}

Alignment by_points(const Call& call, const std::vector<ProbedPoint>& probed) {
  const CsvTable table(call.nominal, {"name", "x_mm", "y_mm", "z_mm"});
  std::vector<NominalPoint> nominal;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    nominal.push_back({table.text(row, "name"), place_in(table, row)});
  }
  return align_points(probed, nominal);
}

Alignment by_planes(const Call& call, const std::vector<ProbedPoint>& probed) {
  const CsvTable table(call.planes, {"name", "x_mm", "y_mm", "z_mm", "nx", "ny", "nz"});
  DatumPlanes planes;
  std::size_t told = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "name");
    NominalPlane* plane = name == "primary"     ? &planes.primary
                          : name == "secondary" ? &planes.secondary
                          : name == "tertiary"  ? &planes.tertiary
                                                : nullptr;
    if (plane == nullptr) table.refuse(row, "name", "primary, secondary or tertiary is needed");
    *plane = {place_in(table, row),
              {table.number(row, "nx"), table.number(row, "ny"), table.number(row, "nz")}};
    if (!(plane->normal.norm() > 0)) table.refuse(row, "nx", "the normal has no length");
    ++told;
  }
  if (told != 3) throw InputError(call.planes, "three planes are needed: primary, secondary and tertiary");
  return align_3_2_1(probed, planes, call.ball_mm);
}

/// The middle of the part to the middle of the points, in each of the 24 attitudes of a cube.
std::vector<RigidMotion> starts_of(const TriangleMesh& surface, const std::vector<ProbedPoint>& probed) {
  const MeshFacts facts = facts_of(surface);
  const Vec3 middle = 0.5 * (facts.lowest + facts.highest);
  Vec3 at = Vec3::Zero();
  for (const ProbedPoint& point : probed) at += point.in_platform / static_cast<double>(probed.size());
  constexpr double kQuarter = std::numbers::pi / 2;
  std::vector<RigidMotion> starts;
  for (int face = 0; face < 6; ++face) {
    const Quaternion up =
        exp_rotation(face < 4 ? Vec3(face * kQuarter, 0, 0) : Vec3(0, (face == 4 ? 1 : -1) * kQuarter, 0));
    for (int turn = 0; turn < 4; ++turn) {
      const Quaternion attitude = exp_rotation({0, 0, turn * kQuarter}) * up;
      starts.push_back({attitude, at - attitude * middle});
    }
  }
  return starts;
}

Alignment by_surface(const Call& call, const std::vector<ProbedPoint>& probed) {
  TriangleMesh surface;
  std::vector<RigidMotion> starts;
  if (!call.cell.empty()) {
    const Cell cell = cell_for(call.cell);
    if (!cell.workpiece) throw InputError(call.cell, "has no [workpiece] to fit to");
    surface = *cell.workpiece->surface;
    starts = {cell.workpiece->carrier_from_solid};
  } else {
    MeshScale scale;
    scale.longest_mm = call.longest_mm;
    scale.flip = call.flip;
    scale.unit = length_unit_of(call.mesh_unit);
    surface = checked_mesh(read_mesh(call.mesh), scale, call.mesh);
    starts = starts_of(surface, probed);
  }
  return align_best_fit(probed, SurfaceTree(surface), starts,
                        {call.ball_mm, call.within_mm, 100, call.free_mm});
}

Alignment aligned(const Call& call) {
  const int told = (call.nominal.empty() ? 0 : 1) + (call.planes.empty() ? 0 : 1) +
                   (call.cell.empty() && call.mesh.empty() ? 0 : 1);
  if (told != 1) {
    throw InputError("command line",
                     "one of --nominal (points), --planes (3-2-1), --cell or --mesh (best fit) is needed");
  }
  const std::vector<ProbedPoint> probed = read_probed(call.probed);
  if (!call.nominal.empty()) return by_points(call, probed);
  if (!call.planes.empty()) return by_planes(call, probed);
  return by_surface(call, probed);
}

void run(const Call& call, const Common& common) {
  const Alignment alignment = aligned(call);
  write_alignment(call.out, alignment);
  for (const std::string& motion : alignment.not_determined) {
    print_warning(fmt::format(
        "the points leave free: {}; along it the part stays where the first guess had it", motion));
  }
  const auto& [rotation, at] = alignment.platform_from_workpiece;
  const Vec6 sigma = alignment.covariance.diagonal().cwiseSqrt();
  const std::string text = fmt::format(
      "{} by {} points, residuals {:.4f} mm RMS, χ² {:.1f} on {:.0f}\n"
      "  at       ({:.4f}, {:.4f}, {:.4f}) ± ({:.4f}, {:.4f}, {:.4f}) mm\n"
      "  attitude w {:.8f} ({:.8f}, {:.8f}, {:.8f}) ± ({:.5f}, {:.5f}, {:.5f})°\n  {}\n",
      alignment.method, alignment.points, alignment.rms_mm, alignment.chi2, alignment.degrees, at.x(), at.y(),
      at.z(), sigma[3], sigma[4], sigma[5], rotation.w(), rotation.x(), rotation.y(), rotation.z(),
      deg_from_rad(sigma[0]), deg_from_rad(sigma[1]), deg_from_rad(sigma[2]), call.out);
  print_result(common, json_of(alignment), text);
}

}  // namespace

void add_align(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "align", "Where the part sits on the platform, by probed points",
                  "asterism align probed.csv --nominal drawing.csv --out alignment.json\n"
                  "  asterism align probed.csv --planes datums.csv --ball-mm 1.5 --out alignment.json\n"
                  "  asterism align probed.csv --cell cell.toml --out alignment.json");
  auto call = std::make_shared<Call>();
  command
      ->add_option("probed", call->probed.points,
                   "CSV name,x_mm,y_mm,z_mm[,sigma_mm] in the platform's frame; with --poses in the "
                   "tracker's, and frame")
      ->required();
  command->add_option("--poses", call->probed.poses,
                      "the tracker's poses CSV: where the platform was in each frame");
  command->add_option("--platform", call->probed.platform, "the platform's body in it")
      ->capture_default_str();
  command->add_option("--out", call->out, "JSON file for `asterism fuse --alignment`")->required();
  command->add_option("--nominal", call->nominal, "CSV name,x_mm,y_mm,z_mm in the part's frame: by points");
  command->add_option("--planes", call->planes,
                      "CSV name,x_mm,y_mm,z_mm,nx,ny,nz of primary, secondary, tertiary: by 3-2-1");
  command->add_option("--cell", call->cell,
                      "best fit to this cell's workpiece, from where it says that it sits");
  command->add_option("--mesh", call->mesh, "best fit to this surface, from 24 attitudes");
  command->add_option("--mesh-unit", call->mesh_unit, "of the mesh's numbers")
      ->check(CLI::IsMember(length_unit_words()));
  command
      ->add_option("--longest-mm", call->longest_mm, "longest edge of the mesh's box, in place of its unit")
      ->check(CLI::PositiveNumber);
  command->add_flag("--flip", call->flip, "the mesh's triangles face inwards");
  command
      ->add_option("--sigma-mm", call->probed.sigma_mm,
                   "of a probed point, each axis, where the file tells none")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--ball-mm", call->ball_mm, "radius of the probe's ball, when its centre is told")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--free-mm", call->free_mm, "a motion known worse than this is told as not determined")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--within-mm", call->within_mm, "how far off the surface a first guess may put a point")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  on_call(*command, common, [=, &common] { run(*call, common); });
}

}  // namespace asterism::app
