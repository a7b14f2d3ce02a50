#include "common/scheme/graph/classify_rows.hpp"

#include "common/algebra/four.hpp"
#include "common/parallel/for_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace diptych::scheme {

namespace {

using algebra::Four;
using algebra::load_three;

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
  const algebra::SharedVectors& C;
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

DIPTYCH_INLINE Four magnitude(const Four& a) {
  return a < 0 ? -a : a;
}
DIPTYCH_INLINE Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}

/// Largest components of X_b - X_a and of C_ab, or of their differences.
struct Largest {
  double X = 0, C = 0;
  Largest() = default;
  DIPTYCH_INLINE Largest(const Four& X_ab, const Four& C_ab)
      : X(std::max({X_ab[0], X_ab[1], X_ab[2]})), C(std::max({C_ab[0], C_ab[1], C_ab[2]})) {}
};

/// Of row a.
DIPTYCH_CLONES Largest largest_of_row(const Rows& rows, std::int64_t a) {
  const Four X_a = load_three(rows.X[a]);
  Four X{}, C{};
  for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
    X = larger(X, magnitude(load_three(rows.X[rows.neighbour[p]]) - X_a));
    C = larger(C, magnitude(load_three(rows.C[p])));
  }
  return {X, C};
}

/// Between rows a and b of the same length.
DIPTYCH_CLONES Largest largest_difference(const Rows& rows,
                                          const RowClasses& classes,
                                          std::int64_t a,
                                          std::int64_t b) {
  const std::int64_t first_a = rows.row[a], first_b = rows.row[b], n = rows.row[a + 1] - first_a;
  const Four X_a = load_three(rows.X[a]), X_b = load_three(rows.X[b]);
  Four X{}, C{};
  for (std::int64_t k = 0; k < n; ++k) {
    const std::int64_t p = classes.pair(first_a, k), q = classes.pair(first_b, k);
    const Four of_a = load_three(rows.X[rows.neighbour[p]]) - X_a;
    const Four of_b = load_three(rows.X[rows.neighbour[q]]) - X_b;
    X = larger(X, magnitude(of_a - of_b));
    C = larger(C, magnitude(load_three(rows.C[p]) - load_three(rows.C[q])));
  }
  return {X, C};
}

/// Hash of row a as it stands. @param in_order  set to 0 where that is not the common order
DIPTYCH_CLONES std::uint64_t hash_row(const Rows& rows, std::int64_t a, char& in_order) {
  Hash hash;
  Entry before{};
  for (std::int64_t p = rows.row[a]; p < rows.row[a + 1]; ++p) {
    const Entry entry = entry_of(rows, a, p);
    if (p > rows.row[a] && entry < before) in_order = 0;
    before = entry;
    hash.add(word_of(rows, entry));
  }
  return hash.value();
}

/// Compares rows of some nodes.
class Classifier {
 public:
  /// @param nodes  one of each set of rows that are known to be equal
  Classifier(const PairGraph& graph, const std::vector<std::int32_t>& nodes)
      : graph_(graph),
        nodes_(nodes),
        rows_{graph.row.data(), graph.neighbour.data(), graph.X.data(), graph.C} {
    std::vector<Largest> parts(static_cast<size_t>(parallel::n_chunks_of(n_rows())));
    parallel::for_chunks(n_rows(), [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
      for (std::int64_t i = begin; i < end; ++i)
        enlarge(parts[chunk], largest_of_row(rows_, nodes_[i]));
    });
    for (const Largest& part : parts)
      enlarge(largest_, part);
    rows_.inverse_X = largest_.X > 0 ? 1 / (grain * largest_.X) : 0;
    rows_.inverse_C = largest_.C > 0 ? 1 / (grain * largest_.C) : 0;
  }

  /// @param classes  gets the order of pairs, where they do not stand in it; `rows` are left
  EqualGroups classify(RowClasses& classes) const {
    std::vector<std::uint64_t> hash(nodes_.size());
    std::vector<char> in_order(static_cast<size_t>(parallel::n_chunks_of(n_rows())), 1);
    parallel::for_chunks(n_rows(), [&](std::int64_t begin, std::int64_t end, std::int64_t chunk) {
      for (std::int64_t i = begin; i < end; ++i)
        hash[i] = hash_row(rows_, nodes_[i], in_order[chunk]);
    });
    if (std::find(in_order.begin(), in_order.end(), 0) != in_order.end()) {
      sort_rows(hash, classes);
    }
    return group_equal(hash, [&](std::int32_t i, std::int32_t j) {
      const std::int64_t a = nodes_[i], b = nodes_[j];
      if (graph_.row[a + 1] - graph_.row[a] != graph_.row[b + 1] - graph_.row[b]) return false;
      const Largest between = largest_difference(rows_, classes, a, b);
      return between.X <= same * largest_.X && between.C <= same * largest_.C;
    });
  }

 private:
  std::int64_t n_rows() const { return static_cast<std::int64_t>(nodes_.size()); }

  static void enlarge(Largest& largest, const Largest& other) {
    largest.X = std::max(largest.X, other.X);
    largest.C = std::max(largest.C, other.C);
  }

  void sort_rows(std::vector<std::uint64_t>& hash, RowClasses& classes) const {
    classes.order.resize(graph_.neighbour.size());
    classes.place.resize(graph_.neighbour.size());
    parallel::for_chunks(n_rows(), [&](std::int64_t begin, std::int64_t end, std::int64_t) {
      std::vector<Entry> row;
      for (std::int64_t i = begin; i < end; ++i)
        hash[i] = sort_row(nodes_[i], row, classes);
    });
  }

  /// @return hash of the row in the common order
  std::uint64_t sort_row(std::int64_t a, std::vector<Entry>& row, RowClasses& classes) const {
    const std::int64_t first = graph_.row[a];
    row.clear();
    for (std::int64_t p = first; p < graph_.row[a + 1]; ++p)
      row.push_back(entry_of(rows_, a, p));
    if (!std::is_sorted(row.begin(), row.end())) std::sort(row.begin(), row.end());
    Hash hash;
    for (size_t k = 0; k < row.size(); ++k) {
      classes.order[first + static_cast<std::int64_t>(k)] =
          static_cast<std::int32_t>(row[k].pair - first);
      classes.place[row[k].pair] = static_cast<std::int32_t>(k);
      hash.add(word_of(rows_, row[k]));
    }
    return hash.value();
  }

  const PairGraph& graph_;
  const std::vector<std::int32_t>& nodes_;
  Rows rows_;
  Largest largest_;
};

}  // namespace

RowClasses classify_rows(const PairGraph& graph) {
  RowClasses classes;
  std::vector<std::int32_t> nodes(graph.X.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  classes.rows = Classifier(graph, nodes).classify(classes);
  return classes;
}

void set_classes(PairGraph& graph) {
  RowClasses classes = classify_rows(graph);
  if (classes.order.empty()) graph.classes = std::move(classes);
}

void set_classes(PairGraph& graph, const EqualGroups& alike) {
  graph.classes.rows =
      joined(alike, Classifier(graph, alike.representative).classify(graph.classes));
}

RowClasses classes_of(const PairGraph& graph) {
  return graph.classes.rows.of.empty() ? classify_rows(graph) : graph.classes;
}

EqualGroups group_by_neighbours(const PairGraph& graph, const RowClasses& classes, bool numbering) {
  const std::vector<std::int32_t>& of = classes.rows.of;
  // of pair k in the common order, as a word
  const auto word = [&](std::int64_t a, std::int64_t k) DIPTYCH_INLINE_LAMBDA {
    const std::int64_t b = graph.neighbour[classes.pair(graph.row[a], k)];
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
