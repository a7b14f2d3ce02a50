#include "common/scheme/row_classes.hpp"

#include "common/algebra/lanes.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace diptych::scheme {

namespace {

/// Rows are hashed by values rounded to this part of the largest, and belong together where they
/// differ by no more than `same`: far above rounding, far below anything that matters.
constexpr double grain = 1e-6, same = 1e-12;

/// Where zero and simple fractions of the largest value are not at the edge of a grain.
constexpr double offset = 0.2718281828;

DIPTYCH_INLINE std::int64_t rounded(double value, double inverse_unit) {
  return static_cast<std::int64_t>(std::floor(value * inverse_unit + offset));
}

/// X_b - X_a of a pair, rounded.
struct Entry {
  std::int64_t z, y, x, pair;
  bool operator<(const Entry& other) const {
    return std::tie(z, y, x) < std::tie(other.z, other.y, other.x);
  }
};

/// What is read of a graph, and the units of rounding.
struct Rows {
  const std::int64_t* row;
  const std::int32_t* neighbour;
  const Vec3* X;
  const Vec3* C;
  double inverse_X = 0, inverse_C = 0;
};

DIPTYCH_INLINE Entry entry_of(const Rows& rows, std::int64_t a, std::int64_t p) {
  const double* X_a = rows.X[a].data();
  const double* X_b = rows.X[rows.neighbour[p]].data();
  return {rounded(X_b[2] - X_a[2], rows.inverse_X), rounded(X_b[1] - X_a[1], rows.inverse_X),
          rounded(X_b[0] - X_a[0], rows.inverse_X), p};
}

/// Of a pair, for the hash of its row: one word, so that the hash does not wait for each number.
DIPTYCH_INLINE std::uint64_t word_of(const Rows& rows, const Entry& entry) {
  const double* C = rows.C[entry.pair].data();
  const std::int64_t numbers[6] = {entry.x,
                                   entry.y,
                                   entry.z,
                                   rounded(C[0], rows.inverse_C),
                                   rounded(C[1], rows.inverse_C),
                                   rounded(C[2], rows.inverse_C)};
  constexpr std::uint64_t factors[6] = {0xBF58476D1CE4E5B9U, 0x94D049BB133111EBU,
                                        0xD6E8FEB86659FD93U, 0xA0761D6478BD642FU,
                                        0xE7037ED1A0B428DBU, 0x8EBC6AF09C88C6E3U};
  std::uint64_t word = 0;
  for (int i = 0; i < 6; ++i)
    word += static_cast<std::uint64_t>(numbers[i]) * factors[i];
  return word;
}

/// Hashes of rows [begin, end) as they stand. @return whether all stand in the common order
DIPTYCH_CLONES bool hash_rows(const Rows& rows,
                              std::int64_t begin,
                              std::int64_t end,
                              std::uint64_t* hash) {
  bool in_order = true;
  for (std::int64_t a = begin; a < end; ++a) {
    Hash row_hash;
    Entry before{};
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const Entry entry = entry_of(rows, a, p);
      if (p > rows.row[a] && entry < before) in_order = false;
      before = entry;
      row_hash.add(word_of(rows, entry));
    }
    hash[a] = row_hash.value();
  }
  return in_order;
}

/// Largest components of X_b - X_a and C_ab over rows [begin, end).
DIPTYCH_CLONES void find_largest(
    const Rows& rows, std::int64_t begin, std::int64_t end, double* largest_X, double* largest_C) {
  for (std::int64_t a = begin; a < end; ++a) {
    for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
      const double* X_b = rows.X[rows.neighbour[p]].data();
      for (int i = 0; i < 3; ++i) {
        *largest_X = algebra::larger(*largest_X, std::fabs(X_b[i] - rows.X[a].data()[i]));
        *largest_C = algebra::larger(*largest_C, std::fabs(rows.C[p].data()[i]));
      }
    }
  }
}

class Classifier {
 public:
  explicit Classifier(const PairGraph& graph)
      : graph_(graph),
        rows_{graph.row.data(), graph.neighbour.data(), graph.X.data(), graph.C.data()} {
    const auto n_chunks = static_cast<size_t>(parallel::n_chunks_of(graph.n_nodes()));
    std::vector<double> X(n_chunks, 0.0), C(n_chunks, 0.0);
    parallel::for_chunks(graph.n_nodes(), [&](auto begin, auto end, auto chunk) {
      find_largest(rows_, begin, end, &X[chunk], &C[chunk]);
    });
    for (size_t i = 0; i < n_chunks; ++i) {
      largest_X_ = std::max(largest_X_, X[i]);
      largest_C_ = std::max(largest_C_, C[i]);
    }
    rows_.inverse_X = largest_X_ > 0 ? 1 / (grain * largest_X_) : 0;
    rows_.inverse_C = largest_C_ > 0 ? 1 / (grain * largest_C_) : 0;
  }

  RowClasses classify() {
    std::vector<std::uint64_t> hash(graph_.X.size());
    std::vector<char> in_order(static_cast<size_t>(parallel::n_chunks_of(graph_.n_nodes())));
    parallel::for_chunks(graph_.n_nodes(), [&](auto begin, auto end, auto chunk) {
      in_order[chunk] = hash_rows(rows_, begin, end, hash.data());
    });
    if (std::find(in_order.begin(), in_order.end(), 0) != in_order.end()) sort_rows(hash);
    classes_.rows = group_equal(hash, [&](auto a, auto b) { return same_rows(a, b); });
    return std::move(classes_);
  }

 private:
  std::int64_t length(std::int64_t a) const { return graph_.row[a + 1] - graph_.row[a]; }

  void sort_rows(std::vector<std::uint64_t>& hash) {
    classes_.order.resize(graph_.neighbour.size());
    classes_.place.resize(graph_.neighbour.size());
    parallel::for_chunks(graph_.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      std::vector<Entry> row;
      for (std::int64_t a = begin; a < end; ++a)
        hash[a] = sort_row(a, row);
    });
  }

  /// @return hash of the row in the common order
  std::uint64_t sort_row(std::int64_t a, std::vector<Entry>& row) {
    const std::int64_t first = graph_.row[a];
    row.clear();
    for (std::int64_t p = first; p < graph_.row[a + 1]; ++p)
      row.push_back(entry_of(rows_, a, p));
    if (!std::is_sorted(row.begin(), row.end())) std::sort(row.begin(), row.end());
    Hash hash;
    for (size_t k = 0; k < row.size(); ++k) {
      classes_.order[first + static_cast<std::int64_t>(k)] =
          static_cast<std::int32_t>(row[k].pair - first);
      classes_.place[row[k].pair] = static_cast<std::int32_t>(k);
      hash.add(word_of(rows_, row[k]));
    }
    return hash.value();
  }

  bool same_rows(std::int64_t a, std::int64_t b) const {
    if (length(a) != length(b)) return false;
    double X = 0, C = 0;  // largest differences
    for (std::int64_t k = 0; k < length(a); ++k) {
      const std::int64_t p = classes_.pair(graph_, a, k), q = classes_.pair(graph_, b, k);
      const double* X_p = graph_.X[graph_.neighbour[p]].data();
      const double* X_q = graph_.X[graph_.neighbour[q]].data();
      for (int i = 0; i < 3; ++i) {
        const double of_a = X_p[i] - graph_.X[a][i], of_b = X_q[i] - graph_.X[b][i];
        X = algebra::larger(X, std::fabs(of_a - of_b));
        C = algebra::larger(C, std::fabs(graph_.C[p][i] - graph_.C[q][i]));
      }
    }
    return X <= same * largest_X_ && C <= same * largest_C_;
  }

  const PairGraph& graph_;
  Rows rows_;
  double largest_X_ = 0, largest_C_ = 0;
  RowClasses classes_;
};

}  // namespace

RowClasses classify_rows(const PairGraph& graph) {
  return Classifier(graph).classify();
}

EqualGroups group_by_neighbours(const PairGraph& graph, const RowClasses& classes, bool numbering) {
  const std::vector<std::int32_t>& of = classes.rows.of;
  // of pair k in the common order, as a word
  const auto word = [&](std::int64_t a, std::int64_t k) DIPTYCH_INLINE_LAMBDA {
    const std::int64_t b = graph.neighbour[classes.pair(graph, a, k)];
    return static_cast<std::uint64_t>(of[b]) +
           (numbering ? static_cast<std::uint64_t>(b - a) << 32 : 0);
  };
  const auto length = [&](std::int64_t a) { return graph.row[a + 1] - graph.row[a]; };
  std::vector<std::uint64_t> hash(of.size());
  parallel::for_chunks(graph.n_nodes(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
    for (std::int64_t a = begin; a < end; ++a) {
      Hash h;
      h.add(static_cast<std::uint64_t>(of[a]));
      for (std::int64_t k = 0; k < length(a); ++k)
        h.add(word(a, k));
      hash[a] = h.value();
    }
  });
  return group_equal(hash, [&](std::int64_t a, std::int64_t b) {
    if (of[a] != of[b]) return false;  // so their rows are of the same length
    for (std::int64_t k = 0; k < length(a); ++k)
      if (word(a, k) != word(b, k)) return false;
    return true;
  });
}

}  // namespace diptych::scheme
