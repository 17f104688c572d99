// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/optimizer_state.hpp"

#include <cstring>
#include <span>
#include <type_traits>

#include "asterism/core/checksum.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Appends; its calls and those of Reader are written once, in `visit` below.
class Writer {
 public:
  void operator()(const std::vector<double>& values) {
    count(values.size());
    raw(values.data(), values.size() * sizeof(double));
  }
  void operator()(const std::string& text) {
    count(text.size());
    raw(text.data(), text.size());
  }
  template <class T>
  void operator()(const std::vector<T>& items) {
    count(items.size());
    for (const T& item : items) visit(*this, item);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) { raw(&value, sizeof value); }
  std::string bytes;

 private:
  void count(std::size_t value) { (*this)(static_cast<std::uint64_t>(value)); }
  void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : left_(bytes) {}
  void operator()(std::vector<double>& values) {
    values.resize(count(sizeof(double)));
    raw(values.data(), values.size() * sizeof(double));
  }
  void operator()(std::string& text) {
    text.resize(count(1));
    raw(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& items) {
    items.resize(count(1));
    for (T& item : items) visit(*this, item);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) { raw(&value, sizeof value); }
  void end() const {
    if (!left_.empty()) fail();
  }

 private:
  [[noreturn]] static void fail() { throw InputError("the state of the optimiser is damaged"); }
  std::size_t count(std::size_t item_size) {
    std::uint64_t value = 0;
    (*this)(value);
    if (value > left_.size() / item_size) fail();
    return value;
  }
  void raw(void* data, std::size_t size) {
    if (size > left_.size()) fail();
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_ = left_.subspan(size);
  }
  std::span<const char> left_;
};

template <class Archive, class T>
requires std::is_arithmetic_v<std::remove_const_t<T>>
void visit(Archive& archive, T& value) { archive(value); }
template <class Archive>
void visit(Archive& archive, const Genes& genes) {
  archive(genes);
}
template <class Archive>
void visit(Archive& archive, Genes& genes) {
  archive(genes);
}

/// `T` is const when writing.
template <class T, class Whole>
concept Is = std::is_same_v<std::remove_const_t<T>, Whole>;

template <class Archive, Is<Candidate> T>
void visit(Archive& archive, T& candidate) {
  archive(candidate.genes);
  archive(candidate.objectives);
  archive(candidate.violations);
  archive(candidate.rank);
}

template <class Archive, Is<GenerationRecord> T>
void visit(Archive& archive, T& record) {
  archive(record.generation);
  archive(record.evaluations);
  archive(record.hypervolume);
  archive(record.feasible_share);
  archive(record.seconds);
}

template <class Archive, Is<IslandState> T>
void visit(Archive& archive, T& island) {
  archive(island.index);
  archive(island.generation);
  archive(island.evaluations);
  archive(island.genes);
  archive(island.objectives);
  archive(island.violations);
  archive(island.rank);
  archive(island.spread);
  archive(island.immigrants);
  archive(island.archive);
  visit(archive, island.closest);
}

template <class Archive, Is<OptimizerState> T>
void visit(Archive& archive, T& state) {
  archive(state.problem);
  archive(state.options);
  archive(state.islands);
  archive(state.reference);
  archive(state.history);
}

template <class T>
std::string written(const T& whole) {
  Writer writer;
  visit(writer, whole);
  return std::move(writer.bytes);
}

template <class T>
T read(const std::string& bytes) {
  T whole;
  Reader reader(bytes);
  visit(reader, whole);
  reader.end();
  return whole;
}

}  // namespace

std::string to_bytes(const OptimizerState& state) { return written(state); }
std::string to_bytes(const IslandState& island) { return written(island); }
OptimizerState optimizer_state_from_bytes(const std::string& bytes) { return read<OptimizerState>(bytes); }
IslandState island_state_from_bytes(const std::string& bytes) { return read<IslandState>(bytes); }

std::uint64_t checksum(const std::vector<Candidate>& candidates) {
  Checksum sum;
  for (const Candidate& candidate : candidates) {
    sum.add(candidate.genes);
    sum.add(candidate.objectives);
  }
  return sum.value();
}

}  // namespace asterism
