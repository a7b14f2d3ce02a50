#include "common/scheme/row_classes.hpp"

#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace diptych::scheme {

namespace {

/// Rows are hashed by values rounded to this part of the largest, and belong together where they
/// differ by no more than `same`: far above rounding, far below anything that matters.
constexpr double grain = 1e-6, same = 1e-12;

/// Where zero and simple fractions of the largest value are not at the edge of a grain.
constexpr double offset = 0.2718281828;

std::int64_t rounded(double value, double inverse_unit) {
  return static_cast<std::int64_t>(std::floor(value * inverse_unit + offset));
}

/// A pair of a row by its rounded X_b - X_a.
struct Entry {
  std::int64_t z, y, x, pair;
  bool operator<(const Entry& other) const {
    return std::tie(z, y, x) < std::tie(other.z, other.y, other.x);
  }
};

class Classifier {
 public:
  explicit Classifier(const PairGraph& graph) : graph_(graph) {
    for (std::int64_t a = 0; a < graph.n_nodes(); ++a) {
      for (std::int64_t p = graph.row[a]; p < graph.row[a + 1]; ++p) {
        largest_X_ = std::max(largest_X_, X_of(a, p).cwiseAbs().maxCoeff());
        largest_C_ = std::max(largest_C_, graph.C[p].cwiseAbs().maxCoeff());
      }
    }
    classes_.order.resize(graph.neighbour.size());
    classes_.C.resize(graph.C.size());
  }

  RowClasses classify() {
    std::vector<std::uint64_t> hash(graph_.X.size());
    parallel::for_chunks(graph_.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      std::vector<Entry> row;
      for (std::int64_t a = begin; a < end; ++a)
        hash[a] = sort_row(a, row);
    });
    classes_.rows = group_equal(hash, [&](auto a, auto b) { return same_rows(a, b); });
    parallel::for_chunks(graph_.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      for (std::int64_t a = begin; a < end; ++a) {
        const std::int32_t b = classes_.rows.representative[classes_.rows.of[a]];
        for (std::int64_t k = 0; k < length(a); ++k)
          classes_.C[pair(a, k)] = graph_.C[pair(b, k)];
      }
    });
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
  std::uint64_t sort_row(std::int64_t a, std::vector<Entry>& row) {
    const double unit_X = largest_X_ > 0 ? 1 / (grain * largest_X_) : 0;
    const double unit_C = largest_C_ > 0 ? 1 / (grain * largest_C_) : 0;
    row.clear();
    for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
      const Vec3 X = X_of(a, p);
      row.push_back({rounded(X[2], unit_X), rounded(X[1], unit_X), rounded(X[0], unit_X), p});
    }
    if (!std::is_sorted(row.begin(), row.end())) std::sort(row.begin(), row.end());
    Hash hash;
    for (size_t k = 0; k < row.size(); ++k) {
      classes_.order[graph_.row[a] + static_cast<std::int64_t>(k)] = row[k].pair;
      for (const std::int64_t x : {row[k].z, row[k].y, row[k].x})
        hash.add(static_cast<std::uint64_t>(x));
      const Vec3& C = graph_.C[row[k].pair];
      for (int i = 0; i < 3; ++i)
        hash.add(static_cast<std::uint64_t>(rounded(C[i], unit_C)));
    }
    return hash.value();
  }

  bool same_rows(std::int64_t a, std::int64_t b) const {
    if (length(a) != length(b)) return false;
    for (std::int64_t k = 0; k < length(a); ++k) {
      const std::int64_t p = pair(a, k), q = pair(b, k);
      if ((X_of(a, p) - X_of(b, q)).cwiseAbs().maxCoeff() > same * largest_X_) return false;
      if ((graph_.C[p] - graph_.C[q]).cwiseAbs().maxCoeff() > same * largest_C_) return false;
    }
    return true;
  }

  const PairGraph& graph_;
  double largest_X_ = 0, largest_C_ = 0;
  RowClasses classes_;
};

}  // namespace

RowClasses classify_rows(const PairGraph& graph) {
  return Classifier(graph).classify();
}

}  // namespace diptych::scheme
