// SPDX-License-Identifier: Apache-2.0
// Plans of views with stand-off, limits and seeds fixed: 300 mm, 200 to 400 mm, 350 x 310 mm, 60 degrees,
// seed 2026. How long the measurability matrix of 8,000 viewpoints and 8,000 samples of a turbine casing
// takes; the paper's cone (r = 453.2 + 0.1208 z, from z = -115 to 485, a wall of 12 mm) by its rings of 96
// and 72 stations and by ours, outer wall and whole; the turbine casing in its cell, tracked, on a platform
// of +-15 degrees. With a folder as argument the cover problems are written there in the OR-Library's form.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/optimization/cover_text.hpp"
#include "asterism/scanning/plan_cover.hpp"
#include "asterism/scanning/planner.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

constexpr std::uint64_t kSeed = 2026;

/// Seconds of the clock and of all processors.
struct Stopwatch {
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::clock_t processors = std::clock();
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  [[nodiscard]] double processor_seconds() const {
    return static_cast<double>(std::clock() - processors) / CLOCKS_PER_SEC;
  }
};

void matrix(const Cell& turbine, bench::Table& table) {
  const TriangleMesh& part = *turbine.workpiece->surface;
  const auto samples = sample_surface(part, 8000, {}, kSeed);
  const auto views = views_of_surface(samples, 8000, 300, rad_from_deg(35), kSeed);
  const RayScene scene(part);
  const Stopwatch watch;
  const BitRows rows = measured_samples(views, samples, Scanner{}, scene, {});
  const double seconds = watch.seconds(), processors = watch.processor_seconds();
  std::size_t seen = 0;
  for (std::size_t i = 0; i < rows.rows(); ++i) seen += count_bits(rows.row(i));
  table.row({"turbine.off, 1.2 m", fmt::format("{}", views.size()), fmt::format("{}", samples.size()),
             fmt::format("{}", seen), fmt::format("{:.2f}", seconds), fmt::format("{:.2f}", processors)});
}

/// The paper's cone before a scanner that nothing watches.
Cell cone_cell(bool outer_wall_only) {
  Cell cell;
  cell.name = "cone";
  cell.rig = rig_of(CameraPair{});
  Target target;
  target.id = "S1";
  target.position = Vec3::Zero();
  cell.movers = {{{"scanner", {target}}, at_rest({})}};
  // So high that the paper's rings at 0 and 300 mm see all of the outer wall.
  const double slope = 0.1208, bottom = -115, top = 485, wall = 12;
  const double low = 453.2 + slope * bottom, high = 453.2 + slope * top;
  Solid part;
  part.name = "cone";
  part.surface = std::make_shared<const TriangleMesh>(
      surface_of_revolution({{low, bottom}, {high, top}, {high - wall, top}, {low - wall, bottom}}, 720));
  cell.workpiece = part;
  cell.scanner = Scanner{};
  if (outer_wall_only) {
    const Frustum within{low - 0.5, high - 0.5 + 2 * slope, top - bottom + 2};
    cell.scan_task.regions = {
        {"all but the outer wall", within, {Quaternion::Identity(), {0, 0, bottom - 1}}, 0}};
  }
  return cell;
}

PlanOptions options_of_bench(int samples, int candidates, int rounds, double exact_s) {
  PlanOptions options;
  options.samples = samples;
  options.candidates = candidates;
  options.rounds = rounds;
  options.cover.exact_s = exact_s;
  return options;
}

/// Nothing but the scanner's own limits.
PlanOptions untracked(PlanOptions options) {
  for (const ScanLimit limit :
       {ScanLimit::ScannerTargets, ScanLimit::PlatformTargets, ScanLimit::Uncertainty}) {
    options.asked.on[static_cast<std::size_t>(limit)] = false;
  }
  options.platform_steps = 1;
  return options;
}

void rings(const std::string& name, const RingPattern& pattern, bench::Table& table) {
  for (const bool outer : {true, false}) {
    const Cell cell = cone_cell(outer);
    const auto samples = sample_surface(*cell.workpiece->surface, 8000, cell.scan_task.regions, kSeed);
    const BitRows rows =
        measured_samples(views_of_rings(pattern), samples, Scanner{}, RayScene(*cell.workpiece->surface), {});
    std::vector<std::uint64_t> covered(rows.words(), 0);
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      for (std::size_t word = 0; word < covered.size(); ++word) covered[word] |= rows.row(i)[word];
    }
    double worth = 0, seen = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      worth += samples[i].worth();
      seen += bit_at(covered, i) ? samples[i].worth() : 0;
    }
    table.row({outer ? "cone, outer wall" : "cone, whole", name, fmt::format("{}", rows.rows()), "-", "-",
               "-", "-", fmt::format("{:.1f}", 100 * seen / worth), "-", "-", "-", "-"});
  }
}

void plan(const std::string& name, const Cell& cell, const PlanOptions& options,
          const std::filesystem::path& out, bench::Table& table) {
  const Stopwatch watch;
  const PlanGround ground = plan_ground(cell, options, kSeed);
  const CandidateStudy study = study_candidates(ground, {}, kSeed, no_progress);
  const double trying_s = watch.seconds();
  const SetCoverProblem problem = plan_problem(ground, study, {}).cover;
  if (!out.empty()) write_file(out / (name + ".txt"), text_of(problem));
  const Stopwatch solving;
  const SetCover cover = solve(problem, options.cover, kSeed, no_progress);
  const double solving_s = solving.seconds();
  PlanOptions without = options;  // the same plan again for its tour; its cover need not be found anew
  without.cover.exact_s = 0;
  const ScanPlan whole = plan_scans(cell, without, kSeed, {}, no_progress);
  table.row({name, fmt::format("ours, {} %", 100 * cell.scan_task.share), fmt::format("{:.0f}", cover.cost),
             fmt::format("{:.0f}", cover.bound), cover.optimal ? "yes" : "no",
             fmt::format("{:.1f}", 100 * cover.gap()), fmt::format("{:.0f}", cover.greedy_cost),
             fmt::format("{:.1f}", 100 * whole.coverable_mm2 / whole.surface_mm2),
             fmt::format("{:.1f}", trying_s), fmt::format("{:.1f}", solving_s),
             fmt::format("{:.0f}", whole.tour_s), fmt::format("{:.0f}", whole.nearest_neighbour_s)});
}

}  // namespace

int main(int count, char** arguments) try {
  const std::filesystem::path out = count > 1 ? arguments[1] : "";
  Cell turbine = cell_of("turbine_casing");
  bench::Table times("Measurability: what each viewpoint measures, two rays a place",
                     {"part", "viewpoints", "samples", "measured", "s", "processor s"});
  matrix(turbine, times);
  bench::Table plans("Plans of views", {"part", "plan", "views", "bound", "optimal", "gap %", "greedy",
                                        "coverable (rings: covered) %", "trying s", "solving s", "tour s",
                                        "nearest neighbour s"});
  rings("the paper's 96", paper_rings_96(), plans);
  rings("the paper's 72", paper_rings_72(), plans);
  Cell outer = cone_cell(true), whole = cone_cell(false);
  plan("cone-outer-wall", outer, untracked(options_of_bench(4000, 3000, 0, 40)), out, plans);
  plan("cone-whole", whole, untracked(options_of_bench(8000, 8000, 0, 10)), out, plans);
  turbine.scan_task.share = 1;
  plan("turbine-casing", turbine, options_of_bench(8000, 8000, 3, 40), out, plans);
  times.print_json();
  plans.print_json();
  return 0;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
