#include "common/scheme/graph/slope_graph.hpp"

#include "common/scheme/graph/equal_groups.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace diptych::scheme {

using algebra::Arrangement;
using algebra::n_lanes;

namespace {

/// The pairs of one unit, chunk by chunk: a node or an offset for each, and weights.
template <int Dim>
struct Unit {
  std::vector<Neighbours> neighbours;
  std::vector<std::int32_t> offset;
  std::vector<SlopeWeights<Dim>> weights;

  void begin() {
    neighbours.clear();
    offset.clear();
    weights.clear();
  }
  void set(size_t chunk, int lane, const algebra::Vec3& weight) {
    for (int i = 0; i < Dim; ++i)
      weights[chunk].component[i][lane] = weight[i];
  }
};

template <int Dim>
void lay_node(const SlopeRows& rows, std::int64_t a, Unit<Dim>& unit) {
  unit.begin();
  for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
    const int lane = static_cast<int>((p - rows.row[a]) % n_lanes);
    if (lane == 0) {
      unit.weights.push_back({});
      std::fill_n(unit.neighbours.emplace_back().node, n_lanes, static_cast<std::int32_t>(a));
    }
    unit.neighbours.back().node[lane] = rows.neighbour[p];
    unit.set(unit.weights.size() - 1, lane, rows.weight[p]);
  }
}

template <int Dim>
void lay_block(const SlopeRows& rows, std::int64_t b, Unit<Dim>& unit) {
  unit.begin();
  const auto n = static_cast<std::int64_t>(rows.row.size()) - 1;
  const std::int64_t begin = b * n_lanes, end = std::min(n, begin + n_lanes);
  for (std::int64_t a = begin; a < end; ++a) {
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p)
      unit.offset.push_back(rows.neighbour[p] - static_cast<std::int32_t>(a));
  }
  std::sort(unit.offset.begin(), unit.offset.end());
  unit.offset.erase(std::unique(unit.offset.begin(), unit.offset.end()), unit.offset.end());
  unit.weights.assign(unit.offset.size(), {});
  for (std::int64_t a = begin; a < end; ++a) {
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const auto offset = rows.neighbour[p] - static_cast<std::int32_t>(a);
      const auto at = std::lower_bound(unit.offset.begin(), unit.offset.end(), offset);
      unit.set(static_cast<size_t>(at - unit.offset.begin()), static_cast<int>(a - begin),
               rows.weight[p]);
    }
  }
}

template <int Dim>
std::uint64_t hash_of(const std::vector<SlopeWeights<Dim>>& weights) {
  Hash hash;
  for (const auto& chunk : weights) {
    for (const auto& lanes : chunk.component) {
      for (const double value : lanes) {
        std::uint64_t word;
        std::memcpy(&word, &value, sizeof word);
        hash.add(word);
      }
    }
  }
  return hash.value();
}

template <class T>
void copy(const std::vector<T>& from, algebra::AlignedArray<T>& to) {
  to = algebra::AlignedArray<T>(static_cast<std::int64_t>(from.size()));
  std::copy(from.begin(), from.end(), to.data());
}

/// Weights that are there already, by their hash.
template <int Dim>
class KnownWeights {
 public:
  /// Where these stand; puts them there where they are new.
  std::int64_t place_of(const std::vector<SlopeWeights<Dim>>& weights) {
    const auto n = static_cast<std::int64_t>(weights.size());
    const auto [begin, end] = known_.equal_range(hash_of(weights));
    for (auto it = begin; it != end; ++it) {
      const auto& [first, length] = it->second;
      if (length == n && std::memcmp(all_.data() + first, weights.data(),
                                     weights.size() * sizeof(SlopeWeights<Dim>)) == 0)
        return first;
    }
    const auto first = static_cast<std::int64_t>(all_.size());
    known_.emplace(hash_of(weights), std::pair{first, n});
    all_.insert(all_.end(), weights.begin(), weights.end());
    return first;
  }
  const std::vector<SlopeWeights<Dim>>& all() const { return all_; }

 private:
  std::vector<SlopeWeights<Dim>> all_;
  std::unordered_multimap<std::uint64_t, std::pair<std::int64_t, std::int64_t>> known_;
};

}  // namespace

std::int64_t SlopeRows::reach() const {
  std::int64_t largest = 0;
  for (size_t a = 0; a + 1 < row.size(); ++a) {
    for (std::int64_t p = row[a]; p < row[a + 1]; ++p)
      largest = std::max(largest, std::abs(neighbour[p] - static_cast<std::int64_t>(a)));
  }
  return largest;
}

template <int Dim>
SlopeGraph<Dim>::SlopeGraph(const SlopeRows& rows, Arrangement arrangement) {
  if (rows.empty()) return;
  const bool in_runs = arrangement == Arrangement::runs;
  const auto n = static_cast<std::int64_t>(rows.row.size()) - 1;
  const std::int64_t n_blocks = algebra::n_blocks_of(n);
  std::vector<std::int64_t> row_of(1, 0), first_of;
  std::vector<Neighbours> all_neighbours;
  std::vector<std::int32_t> all_offsets;
  KnownWeights<Dim> known;
  Unit<Dim> unit;
  for (std::int64_t u = 0; u < (in_runs ? n_blocks : n_blocks * n_lanes); ++u) {
    if (in_runs) {
      lay_block(rows, u, unit);
    } else if (u < n) {
      lay_node(rows, u, unit);
    } else {
      unit.begin();
    }
    first_of.push_back(known.place_of(unit.weights));
    all_neighbours.insert(all_neighbours.end(), unit.neighbours.begin(), unit.neighbours.end());
    all_offsets.insert(all_offsets.end(), unit.offset.begin(), unit.offset.end());
    row_of.push_back(row_of.back() + static_cast<std::int64_t>(unit.weights.size()));
  }
  copy(row_of, row);
  copy(all_neighbours, neighbours);
  copy(all_offsets, offset);
  copy(first_of, first);
  copy(known.all(), weights);
}

template struct SlopeGraph<2>;
template struct SlopeGraph<3>;

}  // namespace diptych::scheme
