#include "common/run/state_hash.hpp"

#include "common/scheme/ranks/own_entries.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace diptych::run {

namespace {

using algebra::n_lanes;

/// Modulo 2^64 each.
struct HashSum {
  std::uint64_t high = 0, low = 0;
  HashSum& operator+=(const HashSum& other) {
    high += other.high;
    low += other.low;
    return *this;
  }
};

template <int Dim>
HashSum hash_of_node(const scheme::Body<Dim>& body,
                     std::int64_t a,
                     std::int32_t number,
                     std::vector<double>& values) {
  values.assign(1, number);
  for (const scheme::Field<Dim>& field : body.fields()) {
    if (field.role != scheme::Role::unknown) continue;
    for (int c = 0; c < field.n_components; ++c)
      values.push_back(field.at(body, a, c));
  }
  const XXH128_hash_t hash = XXH3_128bits(values.data(), values.size() * sizeof(double));
  return {hash.high64, hash.low64};
}

}  // namespace

template <int Dim>
std::string state_hash(const scheme::Body<Dim>& body,
                       const std::vector<std::int32_t>& order,
                       double time) {
  const parallel::Part& part = body.part();
  const scheme::OwnEntries numbers(part, order, body.n_owned);
  std::vector<HashSum> sums(static_cast<size_t>(parallel::n_chunks_of(body.n_blocks)));
  parallel::for_chunks(
      part, body.n_blocks, [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
        const std::int64_t last = std::min(end * n_lanes, body.n_owned);
        const std::span<const std::int32_t> number = numbers.of_chunk(chunk);
        std::vector<double> values;
        for (std::int64_t a = begin * n_lanes; a < last; ++a)
          sums[chunk] += hash_of_node(body, a, number[a - begin * n_lanes], values);
      });
  const HashSum own = parallel::sum_in_order(sums);
  std::array<std::int64_t, 2> words{static_cast<std::int64_t>(own.high),
                                    static_cast<std::int64_t>(own.low)};
  if (!part.is_whole()) part.ranks().reduce(words, {});
  struct {
    double time;
    std::int64_t n_nodes;
    std::array<std::int64_t, 2> sum;
  } const all{time, body.n_owned, words};
  const XXH128_hash_t hash = XXH3_128bits(&all, sizeof all);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

template std::string state_hash(const scheme::Body<2>&, const std::vector<std::int32_t>&, double);
template std::string state_hash(const scheme::Body<3>&, const std::vector<std::int32_t>&, double);

namespace {

/// Of several arrays, one after the other.
class Hash {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    hash_ = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(T), hash_);
  }
  void add(const std::string& text) {
    hash_ = XXH3_64bits_withSeed(text.data(), text.size(), hash_);
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  XXH64_hash_t hash_ = 0;
};

}  // namespace

std::string hash_of_nodes(const scheme::PairGraph& graph) {
  Hash hash;
  hash.add(graph.X);
  hash.add(graph.Omega);
  return hash.text();
}

std::string hash_of_groups(const scheme::PairGraph& graph) {
  Hash hash;
  for (const scheme::BoundaryPatch& patch : graph.patches) {
    hash.add(patch.name);
    hash.add(patch.nodes);
    hash.add(patch.area);
    hash.add(patch.faces);
  }
  return hash.text();
}

}  // namespace diptych::run
