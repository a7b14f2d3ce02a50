#pragma once
/// Numbers below the range of single precision (1e-38) are kept by the processor as denormals,
/// which it works a hundred times slower. They are common in single precision: ahead of a wave the
/// solution decays to them, and squares of areas that are zero but for rounding are such. Sweeps
/// over states in single precision take them as zero.

namespace diptych::algebra {

/// While it lives, denormals of this thread are zero, where asked for and the processor is known.
class FlushToZero {
 public:
#if defined(__SSE__)
  explicit FlushToZero(bool wanted) : before_(__builtin_ia32_stmxcsr()) {
    constexpr unsigned results = 0x8000, operands = 0x0040;
    if (wanted) __builtin_ia32_ldmxcsr(before_ | results | operands);
  }
  ~FlushToZero() {
    __builtin_ia32_ldmxcsr(before_);
  }
#else
  explicit FlushToZero(bool) {}
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

#if defined(__SSE__)
 private:
  unsigned before_;
#endif
};

}  // namespace diptych::algebra
