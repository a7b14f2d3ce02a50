#pragma once
/// What pair sweeps read of neighbours: n components per node, in the arrangement that suits the
/// graph. `rows`: the components of a node side by side, for neighbours anywhere; eight of them are
/// gathered and transposed. `runs`: the nodes of a component side by side, for graphs in which
/// eight consecutive nodes have eight consecutive neighbours (numbered lattices); these are one
/// load.

#include "common/algebra/field.hpp"
#include "common/algebra/gather.hpp"

namespace diptych::algebra {

enum class Arrangement { rows, runs };

/// How tables of a graph are arranged.
struct TableShape {
  Arrangement arrangement = Arrangement::rows;
  std::int64_t guard = 0;  ///< runs: nodes that may be read before the first and after the last
  bool single = false;     ///< values in single precision
};

class NodeTable {
 public:
  NodeTable() = default;
  /// @param row_stride  length of a row, at least n_components
  NodeTable(std::int64_t n_nodes, int n_components, int row_stride, const TableShape& shape)
      : arrangement_(shape.arrangement) {
    const std::int64_t n = n_blocks_of(n_nodes) * n_lanes;
    if (arrangement_ == Arrangement::rows) {
      node_stride_ = row_stride;
      data_ = RealArray(n * row_stride + 4, shape.single);  // gathers read four at a time
      return;
    }
    const std::int64_t line = 64 / (shape.single ? sizeof(float) : sizeof(double));
    const auto whole = [&](std::int64_t length) { return (length + line - 1) / line * line; };
    const std::int64_t guard = whole(shape.guard);
    component_stride_ = whole(n) + 2 * guard;
    if (component_stride_ / line % 2 == 0) component_stride_ += line;  // not all in one set
    data_ = RealArray(component_stride_ * n_components, shape.single);
    first_ = guard;
  }

  Arrangement arrangement() const { return arrangement_; }
  bool is_single() const { return data_.is_single(); }
  bool empty() const { return data_.empty(); }
  std::int64_t bytes() const { return data_.bytes(); }

  double at(std::int64_t node, int component) const { return data_.at(index(node, component)); }
  void set(std::int64_t node, int component, double value) {
    data_.set(index(node, component), value);
  }
  void add(std::int64_t node, int component, double value) {
    set(node, component, at(node, component) + value);
  }
  /// Component 0 of node 0, of a table in the precision of Real; from here node and component count
  /// by their strides.
  template <class Real>
  const Real* origin() const {
    return data_.data<Real>() + first_;
  }
  template <class Real>
  Real* origin() {
    return data_.data<Real>() + first_;
  }
  std::int64_t component_stride() const { return component_stride_; }  ///< 1 in rows
  /// use(the origin), in the precision of the table.
  template <class Use>
  DIPTYCH_INLINE void visit(const Use& use) {
    data_.visit([&](auto* data) DIPTYCH_INLINE_LAMBDA { use(data + first_); });
  }

  /// Component c of the eight nodes of block b.
  DIPTYCH_INLINE Lanes get(std::int64_t b, int c) const {
    Lanes value;
    get_each<1>(b, c, [&](int, const Lanes& v) DIPTYCH_INLINE_LAMBDA { value = v; });
    return value;
  }
  DIPTYCH_INLINE void put(std::int64_t b, int c, const Lanes& value) {
    put_each<1>(b, c, [&](int) DIPTYCH_INLINE_LAMBDA { return value; });
  }
  /// take(c, value) for n components from `first` on of the eight nodes of block b. Asks for
  /// arrangement and precision once, so that loops over components unroll.
  template <int n, class Take>
  DIPTYCH_INLINE void get_each(std::int64_t b, int first, const Take& take) const {
    data_.visit([&](const auto* data) DIPTYCH_INLINE_LAMBDA {
      const auto* p = data + offset(b, first);
      if (arrangement_ == Arrangement::runs) {
#pragma GCC unroll 9
        for (int c = 0; c < n; ++c)
          take(c, load(p + c * component_stride_));
        return;
      }
      Pack<std::decay_t<decltype(*p)>> columns[n];
      read_rows<n>(p, node_stride_, columns);
#pragma GCC unroll 9
      for (int c = 0; c < n; ++c)
        take(c, widened(columns[c]));
    });
  }
  /// Sets them to give(c).
  template <int n, class Give>
  DIPTYCH_INLINE void put_each(std::int64_t b, int first, const Give& give) {
    data_.visit([&](auto* data) DIPTYCH_INLINE_LAMBDA {
      auto* p = data + offset(b, first);
      if (arrangement_ == Arrangement::runs) {
#pragma GCC unroll 9
        for (int c = 0; c < n; ++c)
          store(p + c * component_stride_, give(c));
        return;
      }
      using T = Pack<std::decay_t<decltype(*p)>>;
      T columns[n];
#pragma GCC unroll 9
      for (int c = 0; c < n; ++c)
        columns[c] = __builtin_convertvector(give(c), T);
      write_rows<n>(columns, node_stride_, p);
    });
  }
  /// use(bytes, n) of the memory of nodes [begin, end): in rows of all their components, in runs of
  /// n components from `first` on.
  template <class Use>
  void for_pieces(std::int64_t begin, std::int64_t end, int first, int n, const Use& use) {
    data_.visit([&](auto* data) {
      if (arrangement_ == Arrangement::rows) {
        use_bytes(data + begin * node_stride_, (end - begin) * node_stride_, use);
        return;
      }
      for (int c = first; c < first + n; ++c)
        use_bytes(data + first_ + begin + c * component_stride_, end - begin, use);
    });
  }

 private:
  std::int64_t index(std::int64_t node, int component) const {
    return first_ + node * node_stride_ + component * component_stride_;
  }
  DIPTYCH_INLINE std::int64_t offset(std::int64_t b, int c) const {
    return first_ + b * n_lanes * node_stride_ + c * component_stride_;
  }

  Arrangement arrangement_ = Arrangement::rows;
  std::int64_t node_stride_ = 1, component_stride_ = 1, first_ = 0;
  RealArray data_;
};

}  // namespace diptych::algebra
