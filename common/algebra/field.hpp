#pragma once
/// Storage of nodal fields: blocks of eight nodes, component by component ("array of structures of
/// arrays"), so that pointwise physics loads eight nodes at once. The only place that knows blocks
/// and padding. Node i stands in block i / 8, lane i % 8; the last block is padded.

#include "common/algebra/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace diptych::algebra {

/// To the system, or to the heap.
struct GiveBack {
  size_t mapped = 0;  ///< bytes from the system; 0: of the heap
  void operator()(std::byte* begin) const {
#if defined(__linux__)
    if (mapped > 0) {
      munmap(begin, mapped);
      return;
    }
#endif
    std::free(begin);
  }
};

/// The system's; sweeps read too many streams for the table of small pages.
inline constexpr size_t huge_page = size_t{1} << 21;

/// Bytes of zeros aligned to cache lines, at least `wanted` of them.
class ZeroedMemory {
 public:
  ZeroedMemory() = default;
  /// Megabytes come from the system, as huge pages (SPH 1.2 to 1.5 times faster). A page is there
  /// once it is written to, near the thread that does.
  explicit ZeroedMemory(size_t wanted) {
#if defined(__linux__)
    if (wanted >= huge_page) {
      const size_t bytes = (wanted + huge_page - 1) / huge_page * huge_page;
      void* const mapped = mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (mapped == MAP_FAILED) throw std::bad_alloc();
      const size_t before =
          (huge_page - reinterpret_cast<std::uintptr_t>(mapped) % huge_page) % huge_page;
      auto* const begin = static_cast<std::byte*>(mapped) + before;
      if (before > 0) munmap(mapped, before);
      if (before < huge_page) munmap(begin + bytes, huge_page - before);
      madvise(begin, bytes, MADV_HUGEPAGE);  // advice: refusing it costs only time
      memory_ = {begin, GiveBack{bytes}};
      return;
    }
#endif
    constexpr size_t line = 64;
    const size_t bytes = (wanted + line - 1) / line * line;
    void* const begin = std::aligned_alloc(line, bytes);
    if (begin == nullptr) throw std::bad_alloc();
    __builtin_memset(begin, 0, bytes);
    memory_.reset(static_cast<std::byte*>(begin));
  }
  std::byte* begin() const {
    return memory_.get();
  }

 private:
  std::unique_ptr<std::byte, GiveBack> memory_;
};

/// Zero-initialised memory aligned to cache lines, not copyable.
template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::int64_t n) : size_(n) {
    if (n > 0) memory_ = ZeroedMemory(static_cast<size_t>(n) * sizeof(T));
  }
  T* data() { return reinterpret_cast<T*>(memory_.begin()); }
  const T* data() const { return reinterpret_cast<const T*>(memory_.begin()); }
  T& operator[](std::int64_t i) { return data()[i]; }
  const T& operator[](std::int64_t i) const { return data()[i]; }
  std::int64_t size() const { return size_; }
  std::int64_t bytes() const { return size_ * static_cast<std::int64_t>(sizeof(T)); }

 private:
  ZeroedMemory memory_;
  std::int64_t size_ = 0;
};

inline std::int64_t n_blocks_of(std::int64_t n_nodes) {
  return (n_nodes + n_lanes - 1) / n_lanes;
}

/// Numbers kept in double or in single precision, read and written as doubles.
class RealArray {
 public:
  RealArray() = default;
  RealArray(std::int64_t n, bool single)
      : full_(single ? 0 : n), single_(single ? n : 0), is_single_(single) {}
  bool is_single() const { return is_single_; }
  bool empty() const { return full_.size() + single_.size() == 0; }
  std::int64_t bytes() const { return full_.bytes() + single_.bytes(); }
  /// In the precision they have.
  template <class Real>
  Real* data() {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return single_.data();
    } else {
      return full_.data();
    }
  }
  template <class Real>
  const Real* data() const {
    return const_cast<RealArray*>(this)->data<Real>();
  }
  double at(std::int64_t i) const { return is_single_ ? single_[i] : full_[i]; }
  void set(std::int64_t i, double value) {
    if (is_single_) {
      single_[i] = static_cast<float>(value);
    } else {
      full_[i] = value;
    }
  }
  /// use(pointer to the first), once for a whole block of accesses: a choice for each would cost.
  template <class Use>
  DIPTYCH_INLINE void visit(const Use& use) {
    if (is_single_) {
      use(single_.data());
    } else {
      use(full_.data());
    }
  }
  template <class Use>
  DIPTYCH_INLINE void visit(const Use& use) const {
    if (is_single_) {
      use(single_.data());
    } else {
      use(full_.data());
    }
  }

 private:
  AlignedArray<double> full_;
  AlignedArray<float> single_;
  bool is_single_ = false;
};

/// use(bytes, n) of n values.
template <class Real, class Use>
void use_bytes(Real* values, std::int64_t n, const Use& use) {
  use(reinterpret_cast<std::byte*>(values), static_cast<size_t>(n) * sizeof(Real));
}

class BlockField {
 public:
  BlockField() = default;
  BlockField(std::int64_t n_nodes, int n_components, bool single = false)
      : n_components_(n_components), data_(n_blocks_of(n_nodes) * n_components * n_lanes, single) {}

  int n_components() const { return n_components_; }
  bool empty() const { return data_.empty(); }
  std::int64_t bytes() const { return data_.bytes(); }
  double at(std::int64_t node, int component) const { return data_.at(index(node, component)); }
  void set(std::int64_t node, int component, double value) {
    data_.set(index(node, component), value);
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
  /// take(c, value) for n components from `first` on of the eight nodes of block b.
  template <int n, class Take>
  DIPTYCH_INLINE void get_each(std::int64_t b, int first, const Take& take) const {
    data_.visit([&](const auto* data) DIPTYCH_INLINE_LAMBDA {
      const auto* p = data + (b * n_components_ + first) * n_lanes;
#pragma GCC unroll 9
      for (int c = 0; c < n; ++c)
        take(c, load(p + c * n_lanes));
    });
  }
  /// Sets them to give(c).
  template <int n, class Give>
  DIPTYCH_INLINE void put_each(std::int64_t b, int first, const Give& give) {
    data_.visit([&](auto* data) DIPTYCH_INLINE_LAMBDA {
      auto* p = data + (b * n_components_ + first) * n_lanes;
#pragma GCC unroll 9
      for (int c = 0; c < n; ++c)
        store(p + c * n_lanes, give(c));
    });
  }
  /// use(bytes, n) of the memory of blocks [begin, end), for who sends it elsewhere.
  template <class Use>
  void for_pieces(std::int64_t begin, std::int64_t end, const Use& use) {
    const std::int64_t length = n_components_ * n_lanes;
    data_.visit([&](auto* data) { use_bytes(data + begin * length, (end - begin) * length, use); });
  }

 private:
  std::int64_t index(std::int64_t node, int component) const {
    return (node / n_lanes * n_components_ + component) * n_lanes + node % n_lanes;
  }

  int n_components_ = 0;
  RealArray data_;
};

}  // namespace diptych::algebra
