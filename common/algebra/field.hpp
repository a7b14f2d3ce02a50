#pragma once
/// Storage of nodal fields: blocks of eight nodes, component by component ("array of structures of
/// arrays"), so that pointwise physics loads eight nodes at once. The only place that knows blocks
/// and padding. Node i stands in block i / 8, lane i % 8; the last block is padded.

#include "common/algebra/lanes.hpp"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace diptych::algebra {

/// Zero-initialised memory aligned to cache lines, not copyable. Arrays of megabytes ask for huge
/// pages: sweeps read too many streams for the small pages' table (SPH 1.2 to 1.5 times faster).
template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::int64_t n) : size_(n) {
    if (n == 0) return;
    constexpr size_t huge_page = size_t{1} << 21;
    const size_t wanted = static_cast<size_t>(n) * sizeof(T);
    const size_t page = wanted >= huge_page ? huge_page : 64;
    const size_t bytes = (wanted + page - 1) / page * page;
    auto* p = static_cast<T*>(std::aligned_alloc(page, bytes));
    if (p == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    if (page == huge_page) madvise(p, bytes, MADV_HUGEPAGE);  // advice: refusing it costs only time
#endif
    memory_.reset(p);
    __builtin_memset(static_cast<void*>(p), 0, bytes);
  }
  T* data() {
    return memory_.get();
  }
  const T* data() const {
    return memory_.get();
  }
  T& operator[](std::int64_t i) {
    return memory_.get()[i];
  }
  const T& operator[](std::int64_t i) const {
    return memory_.get()[i];
  }
  std::int64_t size() const {
    return size_;
  }
  std::int64_t bytes() const {
    return size_ * static_cast<std::int64_t>(sizeof(T));
  }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> memory_;
  std::int64_t size_ = 0;
};

inline std::int64_t n_blocks_of(std::int64_t n_nodes) {
  return (n_nodes + n_lanes - 1) / n_lanes;
}

class BlockField {
 public:
  BlockField() = default;
  BlockField(std::int64_t n_nodes, int n_components)
      : n_components_(n_components), data_(n_blocks_of(n_nodes) * n_components * n_lanes) {}

  int n_components() const { return n_components_; }
  bool empty() const { return data_.size() == 0; }
  std::int64_t bytes() const { return data_.bytes(); }
  /// [n_components][8]
  double* block(std::int64_t b) { return data_.data() + b * n_components_ * n_lanes; }
  const double* block(std::int64_t b) const { return data_.data() + b * n_components_ * n_lanes; }
  double& at(std::int64_t node, int component) {
    return block(node / n_lanes)[component * n_lanes + node % n_lanes];
  }
  double at(std::int64_t node, int component) const {
    return block(node / n_lanes)[component * n_lanes + node % n_lanes];
  }

 private:
  int n_components_ = 0;
  AlignedArray<double> data_;
};

}  // namespace diptych::algebra
