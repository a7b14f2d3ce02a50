#include "common/scheme/sweeps/frames.hpp"

#include "common/scheme/body/pointwise.hpp"

namespace diptych::scheme {

template <int Dim>
DIPTYCH_CLONES void set_frames(Body<Dim>& body, std::int64_t begin, std::int64_t end) {
  using Frame = NodeFrame<Dim>;
  const algebra::FlushToZero flush(body.is_single());
  for (std::int64_t b = begin; b < end; ++b) {
    const Tensor<Lanes> F = get_tensor<Dim>(body.F, b, 0, 1), L = velocity_gradient(body, b);
    const Tensor<Lanes> H = algebra::cofactor(F);
    const Lanes half = 0.5 / algebra::determinant(F, H);
    const auto spatial = [&](int i, int j) DIPTYCH_INLINE_LAMBDA {  // J L F^-1 = L H^T
      Lanes sum{};
      for (int k = 0; k < Dim; ++k)
        sum += L(i, k) * H(j, k);
      return sum;
    };
    put_tensor<Dim>(body.frames, b, Frame::F, F, 1);
    for (int i = 0; i < Dim; ++i)
      body.frames.put(b, Frame::u + i, body.u.get(b, i));
    if constexpr (Dim == 3) {
      body.frames.put(b, Frame::spin, half * (spatial(2, 1) - spatial(1, 2)));
      body.frames.put(b, Frame::spin + 1, half * (spatial(0, 2) - spatial(2, 0)));
    }
    body.frames.put(b, Frame::spin + Frame::n_spin - 1, half * (spatial(1, 0) - spatial(0, 1)));
  }
}

template void set_frames(Body<2>&, std::int64_t, std::int64_t);
template void set_frames(Body<3>&, std::int64_t, std::int64_t);

}  // namespace diptych::scheme
