// SPDX-License-Identifier: Apache-2.0
#include "processes.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "asterism/core/result.hpp"

#ifdef ASTERISM_WITH_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#endif

namespace asterism::app {
namespace {

/// Open MPI's mpirun, PMIx (srun) and PMI-2 tell the processes they start by these.
bool started_together() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMI_SIZE"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

#ifdef ASTERISM_WITH_MPI

namespace {

enum class Task : std::int64_t { Evaluate, AdvanceIslands, Dismiss };

/// What became of a piece of work in one process; numbers, for they travel.
enum class Outcome : int { Done, InputWrong, ProgramWrong };

struct Failure {
  Outcome outcome = Outcome::Done;
  std::string message;
};

Failure failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {Outcome::InputWrong, error.what()};
  } catch (const std::exception& error) {
    return {Outcome::ProgramWrong, error.what()};
  }
  return {};
}

int size_of(std::size_t bytes) {
  require(bytes < (std::size_t{1} << 31), "what processes tell one another has less than 2 GB");
  return static_cast<int>(bytes);
}

void send(const std::string& bytes, int to) {
  MPI_Send(bytes.data(), size_of(bytes.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD);
}

std::string receive(int from) {
  MPI_Status status;
  MPI_Probe(from, 0, MPI_COMM_WORLD, &status);
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

/// Genomes of any lengths as one row of numbers: the lengths, then the genes.
std::vector<double> flat(std::span<const Genes> genomes) {
  std::vector<double> numbers;
  for (const Genes& genes : genomes) numbers.push_back(static_cast<double>(genes.size()));
  for (const Genes& genes : genomes) numbers.insert(numbers.end(), genes.begin(), genes.end());
  return numbers;
}

std::vector<Genes> genomes_of(std::span<const double> numbers, std::size_t count) {
  std::vector<Genes> genomes;
  std::size_t at = count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto genes = numbers.subspan(at, static_cast<std::size_t>(numbers[i]));
    genomes.emplace_back(genes.begin(), genes.end());
    at += genes.size();
  }
  return genomes;
}

}  // namespace

struct Processes::Link {
  int rank = 0;
  int count = 1;

  [[nodiscard]] std::size_t first_of_share(std::size_t items, int process) const {
    return items * static_cast<std::size_t>(process) / static_cast<std::size_t>(count);
  }

  /// The first process throws the failure of the first that failed; true where nobody did.
  [[nodiscard]] bool all_done(const Failure& mine) const {
    std::vector<int> outcomes(static_cast<std::size_t>(count));
    int outcome = static_cast<int>(mine.outcome);
    MPI_Allgather(&outcome, 1, MPI_INT, outcomes.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int process = 0; process < count; ++process) {
      const auto theirs = static_cast<Outcome>(outcomes[static_cast<std::size_t>(process)]);
      if (theirs == Outcome::Done) continue;
      if (rank == process && rank != 0) send(mine.message, 0);
      if (rank != 0) return false;
      const std::string message = process == 0 ? mine.message : receive(process);
      if (theirs == Outcome::InputWrong) throw InputError(message);
      throw std::runtime_error(message);
    }
    return true;
  }

  void tell(Task task, std::int64_t a = 0, std::int64_t b = 0) const {
    std::array<std::int64_t, 3> words{static_cast<std::int64_t>(task), a, b};
    MPI_Bcast(words.data(), 3, MPI_INT64_T, 0, MPI_COMM_WORLD);
  }
  [[nodiscard]] static std::array<std::int64_t, 3> listen() {
    std::array<std::int64_t, 3> words{};
    MPI_Bcast(words.data(), 3, MPI_INT64_T, 0, MPI_COMM_WORLD);
    return words;
  }

  void evaluate_share(const OptimizationProblem& problem, std::span<const Genes> genomes,
                      std::span<double> objectives, std::span<double> violations) const;
  void gather_rows(std::span<double> rows, std::size_t items) const;
  void serve_evaluation(const OptimizationProblem& problem, std::size_t count_of_genomes,
                        std::size_t numbers) const;
  void lead_islands(const OptimizationProblem& problem, const OptimizerOptions& options,
                    std::span<IslandState> islands, int generations) const;
  void serve_islands(const OptimizationProblem& problem, const OptimizerOptions& options, int islands,
                     int generations) const;
  void serve(const OptimizationProblem& problem, const OptimizerOptions& options) const;
};

/// Every process has all genomes and fills its rows; the first then has all rows.
void Processes::Link::evaluate_share(const OptimizationProblem& problem, std::span<const Genes> genomes,
                                     std::span<double> objectives, std::span<double> violations) const {
  const std::size_t items = genomes.size();
  const std::size_t first = first_of_share(items, rank), last = first_of_share(items, rank + 1);
  const std::size_t m = objectives.size() / items, c = violations.size() / items;
  const Failure failure = failure_of([&] {
    evaluate_batch(problem, genomes.subspan(first, last - first),
                   objectives.subspan(first * m, (last - first) * m),
                   violations.subspan(first * c, (last - first) * c));
  });
  if (!all_done(failure)) return;
  gather_rows(objectives, items);
  gather_rows(violations, items);
}

void Processes::Link::gather_rows(std::span<double> rows, std::size_t items) const {
  const std::size_t width = rows.size() / items;
  std::vector<int> counts, starts;
  for (int process = 0; process < count; ++process) {
    starts.push_back(size_of(first_of_share(items, process) * width));
    counts.push_back(size_of(first_of_share(items, process + 1) * width) - starts.back());
  }
  const auto me = static_cast<std::size_t>(rank);
  if (rank == 0) {
    MPI_Gatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, rows.data(), counts.data(), starts.data(), MPI_DOUBLE, 0,
                MPI_COMM_WORLD);
  } else {
    MPI_Gatherv(rows.data() + starts[me], counts[me], MPI_DOUBLE, nullptr, nullptr, nullptr, MPI_DOUBLE, 0,
                MPI_COMM_WORLD);
  }
}

void Processes::Link::serve_evaluation(const OptimizationProblem& problem, std::size_t count_of_genomes,
                                       std::size_t size) const {
  std::vector<double> numbers(size);
  MPI_Bcast(numbers.data(), size_of(size), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  const std::vector<Genes> genomes = genomes_of(numbers, count_of_genomes);
  std::vector<double> objectives(count_of_genomes * problem.objectives().size());
  std::vector<double> violations(count_of_genomes * problem.constraints().size());
  evaluate_share(problem, genomes, objectives, violations);
}

/// Island i is carried on by process i modulo their number.
void Processes::Link::lead_islands(const OptimizationProblem& problem, const OptimizerOptions& options,
                                   std::span<IslandState> islands, int generations) const {
  tell(Task::AdvanceIslands, static_cast<std::int64_t>(islands.size()), generations);
  const auto process_of = [&](std::size_t island) { return static_cast<int>(island) % count; };
  for (std::size_t i = 0; i < islands.size(); ++i) {
    if (process_of(i) != 0) send(to_bytes(islands[i]), process_of(i));
  }
  const Failure failure = failure_of([&] {
    for (std::size_t i = 0; i < islands.size(); ++i) {
      if (process_of(i) == 0) advance_island(problem, options, islands[i], generations);
    }
  });
  if (!all_done(failure)) return;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    if (process_of(i) != 0) islands[i] = island_state_from_bytes(receive(process_of(i)));
  }
}

void Processes::Link::serve_islands(const OptimizationProblem& problem, const OptimizerOptions& options,
                                    int islands, int generations) const {
  std::vector<IslandState> mine;
  for (int i = rank; i < islands; i += count) mine.push_back(island_state_from_bytes(receive(0)));
  const Failure failure = failure_of([&] {
    for (IslandState& island : mine) advance_island(problem, options, island, generations);
  });
  if (!all_done(failure)) return;
  for (const IslandState& island : mine) send(to_bytes(island), 0);
}

Processes::Processes() {
  if (!started_together()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  link_ = std::make_unique<Link>();
  MPI_Comm_rank(MPI_COMM_WORLD, &link_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &link_->count);
}

Processes::~Processes() {
  if (link_ == nullptr) return;
  if (leads() && link_->count > 1) link_->tell(Task::Dismiss);
  MPI_Finalize();
}

bool Processes::leads() const { return link_ == nullptr || link_->rank == 0; }
int Processes::count() const { return link_ == nullptr ? 1 : link_->count; }

void Processes::together(const std::function<void()>& work) {
  if (link_ == nullptr) return work();
  if (!link_->all_done(failure_of(work))) throw Dismissed{};
}

OptimizerWorkers Processes::workers(const OptimizationProblem& problem, const OptimizerOptions& options) {
  if (count() == 1) return {};
  const Link& link = *link_;
  OptimizerWorkers workers;
  if (options.islands > 1) {
    workers.run_islands = [&](std::span<IslandState> islands, int generations) {
      link.lead_islands(problem, options, islands, generations);
    };
    return workers;
  }
  workers.evaluate = [&link](const OptimizationProblem& asked, std::span<const Genes> genomes,
                             std::span<double> objectives, std::span<double> violations) {
    if (genomes.empty()) return;
    std::vector<double> numbers = flat(genomes);
    link.tell(Task::Evaluate, static_cast<std::int64_t>(genomes.size()),
              static_cast<std::int64_t>(numbers.size()));
    MPI_Bcast(numbers.data(), size_of(numbers.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    link.evaluate_share(asked, genomes, objectives, violations);
  };
  return workers;
}

void Processes::serve(const OptimizationProblem& problem, const OptimizerOptions& options) {
  require(!leads(), "the first process leads");
  try {
    link_->serve(problem, options);
  } catch (const std::exception& error) {
    // The others wait for this process and cannot be told otherwise.
    fmt::print(stderr, "asterism: process {} failed: {}\n", link_->rank, error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}

void Processes::Link::serve(const OptimizationProblem& problem, const OptimizerOptions& options) const {
  for (;;) {
    const auto [task, a, b] = listen();
    switch (static_cast<Task>(task)) {
      case Task::Evaluate:
        serve_evaluation(problem, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        break;
      case Task::AdvanceIslands:
        serve_islands(problem, options, static_cast<int>(a), static_cast<int>(b));
        break;
      case Task::Dismiss:
        return;
    }
  }
}

#else  // no MPI: this process is alone

struct Processes::Link {};

Processes::Processes() {
  const char* count = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (started_together() && (count == nullptr || std::string(count) != "1"))
    throw InputError(
        "several processes were started together, but this program was built without MPI; install "
        "libopenmpi-dev and build again, or start one process");
}
Processes::~Processes() = default;
bool Processes::leads() const { return true; }
int Processes::count() const { return 1; }
void Processes::together(const std::function<void()>& work) { work(); }
OptimizerWorkers Processes::workers(const OptimizationProblem&, const OptimizerOptions&) { return {}; }
void Processes::serve(const OptimizationProblem&, const OptimizerOptions&) {}

#endif

}  // namespace asterism::app
