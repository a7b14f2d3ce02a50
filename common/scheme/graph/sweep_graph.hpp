#pragma once
/// The pair graph as the sweeps read it: chunks of eight pairs, a lane each, in one of two
/// arrangements (algebra/node_table.hpp).
///
/// rows  A chunk holds eight pairs of one node; the eight neighbours are gathered. For any graph.
/// runs  A chunk holds, for the eight nodes a..a+7 of a block, their pairs with the nodes at the
///       same offset in the numbering, b..b+7: no gather, no sum over lanes. Where a node has no
///       such neighbour its C_ab and C_ba are zero. Taken where chunks are full enough: lattices in
///       their natural numbering, for both methods and all element types.
///
/// Geometry stands once for all rows (runs: blocks) that have the same (row_classes.hpp); on
/// lattices it stays in the cache, elsewhere it is a stream of memory. X_b - X_a is made from the
/// positions. Per directed pair in 3-D the strain-rate sweep streams 28 bytes at most, the momentum
/// sweep 44 in rows and 26 in runs, where it works each pair once; 4 where all is shared. What only
/// scales the dissipation (|S_ab|; in rows S_ab too) is kept in single precision: S_ba = -S_ab
/// holds exactly, and the jump that it multiplies is exact, so no identity is touched. A graph
/// whose C_ab are single-precision numbers (set_precision) has them kept so: 16 and 32 bytes in
/// rows, 16 and 14 in runs.

#include "common/algebra/node_table.hpp"
#include "common/scheme/graph/pair_graph.hpp"
#include "common/scheme/graph/pair_runs.hpp"
#include "common/scheme/graph/work_order.hpp"

#include <cstdint>

namespace diptych::scheme {

using algebra::Arrangement;

/// Row of v or X in a table of rows: four (3-D) or two numbers.
template <int Dim>
inline constexpr int vector_stride = Dim == 3 ? 4 : 2;

/// A vector of eight pairs: C_ab for the strain rates, C_ba for the internal forces where each node
/// sums its own (rows), S_ab for the face correction and the dissipation of rows;
template <int Dim, class Real>
struct PairVectors {
  Real component[Dim][algebra::n_lanes];  ///< m^2
};

/// for the internal forces where each pair is worked once, for both of its nodes (runs);
template <int Dim, class Real>
struct MutualGeometry {
  Real C_ab[Dim][algebra::n_lanes], C_ba[Dim][algebra::n_lanes];  ///< m^2
  float area[algebra::n_lanes];                                   ///< m^2, |S_ab|
};

/// for the dissipation of rows.
struct PairArea {
  float area[algebra::n_lanes];  ///< m^2, |S_ab|
};

/// Chunks ahead of the work that the sweeps ask memory for: the processor's own prefetching stops
/// at pages.
inline constexpr std::int64_t chunks_ahead = 8;

template <class Chunk>
DIPTYCH_INLINE void prefetch(const Chunk* chunk) {
  const char* bytes = reinterpret_cast<const char*>(chunk);
#pragma GCC unroll 8
  for (size_t i = 0; i < sizeof(Chunk); i += 64)
    __builtin_prefetch(bytes + i);
}

/// Geometry of chunks in the precision of the graph.
template <template <int, class> class Geometry, int Dim>
class GeometryArray {
 public:
  GeometryArray() = default;
  GeometryArray(std::int64_t n, bool single)
      : full_(single ? 0 : n), single_(single ? n : 0), is_single_(single) {}
  std::int64_t bytes() const { return full_.bytes() + single_.bytes(); }
  std::int64_t size() const { return full_.size() + single_.size(); }
  bool is_single() const { return is_single_; }
  /// Goes through consecutive chunks.
  class Cursor {
   public:
    Cursor() = default;
    DIPTYCH_INLINE Cursor(const GeometryArray& array, std::int64_t chunk)
        : full_(array.full_.data() + chunk),
          single_(array.single_.data() + chunk),
          is_single_(array.is_single_) {}
    /// use(geometry of the next chunk), and asks for what comes soon.
    template <class Use>
    DIPTYCH_INLINE void next(const Use& use) {
      if (is_single_) {
        prefetch(single_ + chunks_ahead);
        use(*single_++);
      } else {
        prefetch(full_ + chunks_ahead);
        use(*full_++);
      }
    }

   private:
    const Geometry<Dim, double>* full_ = nullptr;
    const Geometry<Dim, float>* single_ = nullptr;
    bool is_single_ = false;
  };
  template <class Change>
  void change(std::int64_t chunk, const Change& change) {
    if (is_single_) {
      change(single_[chunk]);
    } else {
      change(full_[chunk]);
    }
  }

 private:
  algebra::AlignedArray<Geometry<Dim, double>> full_;
  algebra::AlignedArray<Geometry<Dim, float>> single_;
  bool is_single_ = false;
};

/// Runs only: every pair once, in the chunks of the block of its lower node, ascending offsets.
template <int Dim>
struct MutualPairs {
  algebra::AlignedArray<std::int64_t> row;     ///< [n_blocks + 1] into chunks
  algebra::AlignedArray<std::int32_t> offset;  ///< b - a > 0 of each chunk
  algebra::AlignedArray<std::int64_t> first;   ///< [n_blocks] into the geometry
  GeometryArray<MutualGeometry, Dim> geometry;
  WorkOrder order;
  std::int64_t bytes() const {
    return row.bytes() + offset.bytes() + first.bytes() + geometry.bytes() + order.bytes();
  }
};

template <int Dim>
struct SweepGraph {
  std::int64_t n_nodes = 0, n_blocks = 0, n_pairs = 0;
  algebra::TableShape shape;                     ///< of the tables that sweeps of this graph read
  algebra::AlignedArray<std::int64_t> row;       ///< into chunks; by node (rows) or block (runs)
  algebra::AlignedArray<Neighbours> neighbours;  ///< rows: of each chunk; padded with the node
  algebra::AlignedArray<std::int32_t> offset;    ///< runs: b - a of each chunk
  algebra::AlignedArray<std::int64_t> first;     ///< into the geometry; by node or block
  GeometryArray<PairVectors, Dim> strain;        ///< C_ab
  GeometryArray<PairVectors, Dim> force;         ///< rows: C_ba
  algebra::AlignedArray<PairArea> area;          ///< rows
  algebra::AlignedArray<PairVectors<Dim, float>> face;  ///< S_ab, not in rows of single precision
  MutualPairs<Dim> mutual;
  SlopeGraph<Dim> slopes;  ///< empty: jumps are reconstructed with dF/dt
  algebra::NodeTable X;    ///< m; in single precision from the middle of the body
  algebra::AlignedArray<double> inverse_Omega;  ///< [n_blocks * 8] 1/m^3, 0 in the padding
  algebra::AlignedArray<double> Omega;          ///< [n_blocks * 8] m^3, 0 in the padding
  algebra::BlockField C_sum;                    ///< [n_nodes][Dim] sum_b C_ab

  /// Empty, to be given what another rank has built (ranks/share_graph.hpp).
  SweepGraph() = default;
  /// @param has_slopes  those of the graph are used, between the pairs that they are for
  explicit SweepGraph(const PairGraph& graph, bool has_slopes = false);
  /// In an arrangement of choice, for tests and measurements.
  SweepGraph(const PairGraph& graph, Arrangement arrangement, bool has_slopes = false);
  std::int64_t bytes() const;

 private:
  SweepGraph(const PairGraph& graph, bool has_slopes, const PairRuns& runs);
  SweepGraph(const PairGraph& graph,
             Arrangement arrangement,
             bool has_slopes,
             const PairRuns& runs);
};

/// As T: eight doubles or singles.
template <int Dim, class Real, class T>
DIPTYCH_INLINE void load_vectors(const PairVectors<Dim, Real>& from, T (&to)[Dim]) {
  for (int i = 0; i < Dim; ++i)
    to[i] = algebra::load_as<T>(from.component[i]);
}

/// C_ab or C_ba of consecutive chunks.
template <int Dim>
class VectorCursor {
 public:
  DIPTYCH_INLINE VectorCursor(const GeometryArray<PairVectors, Dim>& array, std::int64_t chunk)
      : cursor_(array, chunk) {}
  template <class T>
  DIPTYCH_INLINE void next(T (&C)[Dim]) {
    cursor_.next([&](const auto& vectors) DIPTYCH_INLINE_LAMBDA { load_vectors(vectors, C); });
  }

 private:
  typename GeometryArray<PairVectors, Dim>::Cursor cursor_;
};

/// Weights of slopes of consecutive chunks.
template <int Dim>
struct SlopeCursor {
  const SlopeWeights<Dim>* weights;
  template <class T>
  DIPTYCH_INLINE void next(T (&weight)[Dim]) {
    for (int i = 0; i < Dim; ++i)
      weight[i] = algebra::load_as<T>(weights->component[i]);
    ++weights;
  }
};

/// C_ab of two blocks of runs, side by side.
template <int Dim>
class TwoCursors {
 public:
  DIPTYCH_INLINE TwoCursors(const GeometryArray<PairVectors, Dim>& array,
                            std::int64_t first,
                            std::int64_t second)
      : first_(array, first), second_(array, second) {}
  DIPTYCH_INLINE void next(algebra::WideSingles (&C)[Dim]) {
    algebra::SingleLanes first[Dim], second[Dim];
    first_.next(first);
    second_.next(second);
    for (int i = 0; i < Dim; ++i)
      C[i] = algebra::joined(first[i], second[i]);
  }

 private:
  VectorCursor<Dim> first_, second_;
};

/// S_ab of consecutive chunks; in rows of single precision 1/2 (C_ab - C_ba).
template <int Dim>
class FaceCursor {
 public:
  DIPTYCH_INLINE FaceCursor(const SweepGraph<Dim>& graph, std::int64_t chunk)
      : face_(graph.face.data() + chunk),
        is_stored_(graph.face.size() > 0),
        strain_(graph.strain, chunk),
        force_(graph.force, chunk) {}
  template <class T>
  DIPTYCH_INLINE void next(T (&S_ab)[Dim]) {
    if (is_stored_) {
      next_stored(S_ab);
    } else {
      T C_ba[Dim];
      next(S_ab, C_ba);
    }
  }
  /// Rows: C_ba too.
  template <class T>
  DIPTYCH_INLINE void next(T (&S_ab)[Dim], T (&C_ba)[Dim]) {
    force_.next(C_ba);
    if (is_stored_) {
      next_stored(S_ab);
      return;
    }
    strain_.next(S_ab);
    for (int i = 0; i < Dim; ++i)
      S_ab[i] = 0.5 * (S_ab[i] - C_ba[i]);
  }

 private:
  template <class T>
  DIPTYCH_INLINE void next_stored(T (&S_ab)[Dim]) {
    prefetch(face_ + chunks_ahead);
    load_vectors(*face_++, S_ab);
  }

  const PairVectors<Dim, float>* face_;
  bool is_stored_;
  VectorCursor<Dim> strain_, force_;
};

extern template struct SweepGraph<2>;
extern template struct SweepGraph<3>;

}  // namespace diptych::scheme
