#include "common/scheme/row_classes.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <unordered_map>

namespace diptych::scheme {

namespace {

/// Rows are grouped by values rounded to this part of the largest, and belong together where they
/// differ by no more than `same`: far above rounding, far below anything that matters.
constexpr double grain = 1e-6, same = 1e-12;

/// Where zero and simple fractions of the largest value are not at the edge of a grain.
constexpr double offset = 0.2718281828;

std::int64_t rounded(double value, double inverse_unit) {
  return static_cast<std::int64_t>(std::floor(value * inverse_unit + offset));
}

class Hash {
 public:
  void add(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15ULL;
    hash_ ^= hash_ >> 29;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 1469598103934665603ULL;
};

/// Calls work(a) for all nodes.
template <class Work>
void for_nodes(std::int64_t n_nodes, const Work& work) {
  parallel::for_chunks(n_nodes, [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a)
      work(a);
  });
}

/// Assigns each row to the first earlier row that it equals.
/// @param hash   of a row; equal rows must have equal hashes
/// @param equal  of two nodes
template <class Equal>
void group_rows(const std::vector<std::uint64_t>& hash, const Equal& equal, RowClasses& classes) {
  std::unordered_multimap<std::uint64_t, std::int32_t> known;
  classes.of_row.resize(hash.size());
  classes.representative.clear();
  for (size_t a = 0; a < hash.size(); ++a) {
    std::int32_t found = -1;
    const auto [begin, end] = known.equal_range(hash[a]);
    for (auto it = begin; it != end && found < 0; ++it) {
      if (equal(classes.representative[it->second], static_cast<std::int32_t>(a))) {
        found = it->second;
      }
    }
    if (found < 0) {
      found = static_cast<std::int32_t>(classes.representative.size());
      classes.representative.push_back(static_cast<std::int32_t>(a));
      known.emplace(hash[a], found);
    }
    classes.of_row[a] = found;
  }
}

struct Scales {
  double X = 0, C = 0;  ///< largest |X_b - X_a|, |C_ab|
};

class Classifier {
 public:
  explicit Classifier(const PairGraph& graph) : graph_(graph) {
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        scales_.X = std::max(scales_.X, X_of(a, p).cwiseAbs().maxCoeff());
        scales_.C = std::max(scales_.C, graph.C[p].cwiseAbs().maxCoeff());
      }
    }
    classes_.order.resize(graph.neighbour.size());
    classes_.C = graph.C;
  }

  RowClasses classify() {
    std::vector<std::uint64_t> hash(graph_.X.size());
    for_nodes(graph_.n_nodes(), [&](std::int64_t a) { hash[a] = sort_row(a); });
    group_rows(
        hash, [&](auto a, auto b) { return same_rows(a, b); }, classes_);
    take_representatives();
    const std::vector<std::int32_t> by_row = classes_.of_row;
    for_nodes(graph_.n_nodes(), [&](std::int64_t a) { hash[a] = hash_of_reverse(a, by_row[a]); });
    const auto equal = [&](auto a, auto b) {
      return by_row[a] == by_row[b] && same_reverse_bits(a, b);
    };
    group_rows(hash, equal, classes_);
    return std::move(classes_);
  }

 private:
  Vec3 X_of(std::int64_t a, std::int64_t p) const {
    return graph_.X[graph_.neighbour[p]] - graph_.X[a];
  }
  std::int64_t length(std::int64_t a) const { return graph_.row[a + 1] - graph_.row[a]; }
  /// Pair k of row a in the common order.
  std::int64_t pair(std::int64_t a, std::int64_t k) const {
    return classes_.order[graph_.row[a] + k];
  }

  /// Sorts the pairs of row a. @return hash of its rounded X and C
  std::uint64_t sort_row(std::int64_t a) {
    struct Entry {
      std::int64_t z, y, x, pair;
      bool operator<(const Entry& other) const {
        return std::tie(z, y, x) < std::tie(other.z, other.y, other.x);
      }
    };
    std::vector<Entry> row;
    row.reserve(static_cast<size_t>(length(a)));
    const double unit_X = scales_.X > 0 ? 1 / (grain * scales_.X) : 0;
    const double unit_C = scales_.C > 0 ? 1 / (grain * scales_.C) : 0;
    for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
      const Vec3 X = X_of(a, p);
      row.push_back({rounded(X[2], unit_X), rounded(X[1], unit_X), rounded(X[0], unit_X), p});
    }
    std::sort(row.begin(), row.end());
    Hash hash;
    for (size_t k = 0; k < row.size(); ++k) {
      classes_.order[graph_.row[a] + static_cast<std::int64_t>(k)] = row[k].pair;
      const Vec3& C = graph_.C[row[k].pair];
      for (const std::int64_t x : {row[k].z, row[k].y, row[k].x})
        hash.add(static_cast<std::uint64_t>(x));
      for (int i = 0; i < 3; ++i)
        hash.add(static_cast<std::uint64_t>(rounded(C[i], unit_C)));
    }
    return hash.value();
  }

  bool same_rows(std::int64_t a, std::int64_t b) const {
    if (length(a) != length(b)) return false;
    for (std::int64_t k = 0; k < length(a); ++k) {
      const std::int64_t p = pair(a, k), q = pair(b, k);
      if ((X_of(a, p) - X_of(b, q)).cwiseAbs().maxCoeff() > same * scales_.X) return false;
      if ((graph_.C[p] - graph_.C[q]).cwiseAbs().maxCoeff() > same * scales_.C) return false;
    }
    return true;
  }

  void take_representatives() {
    for_nodes(graph_.n_nodes(), [&](std::int64_t a) {
      const std::int32_t b = classes_.representative[classes_.of_row[a]];
      for (std::int64_t k = 0; k < length(a); ++k)
        classes_.C[pair(a, k)] = graph_.C[pair(b, k)];
    });
  }

  const Vec3& reverse_C(std::int64_t a, std::int64_t k) const {
    return classes_.C[graph_.reverse[pair(a, k)]];
  }
  std::uint64_t hash_of_reverse(std::int64_t a, std::int32_t row_class) const {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(row_class));
    for (std::int64_t k = 0; k < length(a); ++k) {
      for (int i = 0; i < 3; ++i) {
        std::uint64_t word;
        std::memcpy(&word, reverse_C(a, k).data() + i, sizeof word);
        hash.add(word);
      }
    }
    return hash.value();
  }
  bool same_reverse_bits(std::int64_t a, std::int64_t b) const {
    for (std::int64_t k = 0; k < length(a); ++k) {
      if (std::memcmp(reverse_C(a, k).data(), reverse_C(b, k).data(), 3 * sizeof(double)) != 0) {
        return false;
      }
    }
    return true;
  }

  const PairGraph& graph_;
  Scales scales_;
  RowClasses classes_;
};

}  // namespace

RowClasses classify_rows(const PairGraph& graph) {
  return Classifier(graph).classify();
}

}  // namespace diptych::scheme
