#pragma once
/// Flop and bytes per directed pair of the pair sweeps, counted by hand in their code (linear
/// reconstruction, no limiter, isotropic impedance; a multiply-add is two flop). In 3-D:
///   strain rates       3 differences, 9 multiply-adds: 21 flop;
///                      28 bytes of geometry streamed, 24 read of the neighbour
///   momentum           of a pair, both directions: v_b - v_a and S 6, P_a C_ab - P_b C_ba 36,
///                      (H_a + H_b) S 27, (L_a + L_b) X 27, jump 6, impedance means 4, h.jump and
///                      h.h 12, ratio 4, D and its area 13, sums 12: 147 flop, half of that for a
///                      directed pair (rows, which work every pair twice, make 126 of each);
///                      26 bytes streamed, 44 in rows, 280 read of the neighbour
///   face correction    9 differences, 9 + 9 multiply-adds: 45 flop, twice a stage;
///                      20 bytes streamed, 96 read
/// X_b - X_a, three differences from the positions, is not counted: another layout would read it.
/// In 2-D: 10, (4 + 16 + 12 + 12 + 4 + 4 + 8 + 4 + 9 + 8) / 2 = 40.5, 20 flop; 20, 18 and 16 bytes.
/// Bytes streamed are those of rows that differ; where rows share their geometry it stays in the
/// cache, and a share of the bandwidth above 100 % says so.
/// Work on nodes alone is not counted.

namespace diptych::probes {

/// Of one pair sweep.
struct PairWork {
  double flop = 0;
  double streamed = 0;  ///< bytes of geometry
};

inline PairWork strain_work(int dimension) {
  return dimension == 3 ? PairWork{21, 28} : PairWork{10, 20};
}
inline PairWork momentum_work(int dimension) {
  return dimension == 3 ? PairWork{73.5, 26} : PairWork{40.5, 18};
}
inline PairWork correction_work(int dimension) {
  return dimension == 3 ? PairWork{45, 20} : PairWork{20, 16};
}

/// Of a whole stage.
inline PairWork stage_work(int dimension, bool face_correction) {
  const PairWork s = strain_work(dimension), m = momentum_work(dimension),
                 c = correction_work(dimension);
  const double n = face_correction ? 2 : 0;
  return {s.flop + m.flop + n * c.flop, s.streamed + m.streamed + n * c.streamed};
}

}  // namespace diptych::probes
