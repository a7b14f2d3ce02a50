/// The operations of a placed program, for the blocks of a strip.

#include "common/algebra/lane_functions.hpp"
#include "common/functions/placed_program.hpp"

#include <cmath>

namespace diptych::functions {

using algebra::n_lanes;

namespace {

constexpr int largest_power = 16;  // by multiplications

bool is_whole(double p) {
  return p == std::floor(p) && std::fabs(p) <= largest_power;
}

/// a^p of whole p by squares.
DIPTYCH_INLINE Lanes whole_power(const Lanes& a, int p) {
  Lanes square = a, product = Lanes{} + 1.0;
  for (int k = p < 0 ? -p : p; k > 0; k /= 2) {
    if (k % 2 == 1) product = product * square;
    square = square * square;
  }
  return p < 0 ? 1.0 / product : product;
}

DIPTYCH_INLINE Lanes constant_power(const Lanes& a, double p) {
  if (p == 2) return a * a;
  if (p == 0.5) return algebra::square_root(a);
  if (p == -0.5) return 1.0 / algebra::square_root(a);
  if (is_whole(p)) return whole_power(a, static_cast<int>(p));
  Lanes r;
  for (int lane = 0; lane < n_lanes; ++lane)
    r[lane] = std::pow(a[lane], p);
  return r;
}

DIPTYCH_INLINE Lanes truth(const algebra::LaneBits& condition) {
  return condition != 0 ? Lanes{} + 1.0 : Lanes{};
}

/// By the standard library, lane by lane.
void result_of_lanes(
    const Operation& o, const Lanes& a, const Lanes& b, const Lanes& c, Lanes& result) {
  for (int lane = 0; lane < n_lanes; ++lane)
    result[lane] = result_of(o, a[lane], b[lane], c[lane]);
}

}  // namespace

DIPTYCH_CLONES void PlacedProgram::run(const Instruction& instruction,
                                       std::int64_t strip,
                                       const LaneBlock* scalars,
                                       LaneBlock* registers) const {
  const Operation& o = instruction.operation;
  const double constant = o.constant;
  const Blocks a = blocks(instruction.arguments[0], strip, scalars, registers);
  const Blocks b = blocks(instruction.arguments[1], strip, scalars, registers);
  LaneBlock* const to = registers + instruction.to * width_;
  const int n = width_;
  const auto one = [&](const auto& f) DIPTYCH_INLINE_LAMBDA {
    for (int w = 0; w < n; ++w)
      to[w].v = f(a[w]);
  };
  const auto two = [&](const auto& f) DIPTYCH_INLINE_LAMBDA {
    for (int w = 0; w < n; ++w)
      to[w].v = f(a[w], b[w]);
  };
  if (instruction.fusion != Fusion::none) {
    const Blocks c = blocks(instruction.arguments[2], strip, scalars, registers);
    const double sign_of_product = instruction.fusion == Fusion::reversed_minus ? -1 : 1;
    const double sign = instruction.fusion == Fusion::minus ? -1 : 1;
    if (o.op == Operator::scale) {
      const double factor = sign_of_product * constant;
      for (int w = 0; w < n; ++w)
        to[w].v = factor * a[w] + sign * c[w];
      return;
    }
    if (instruction.fusion == Fusion::plus) {
      for (int w = 0; w < n; ++w)
        to[w].v = a[w] * b[w] + c[w];
    } else if (instruction.fusion == Fusion::minus) {
      for (int w = 0; w < n; ++w)
        to[w].v = a[w] * b[w] - c[w];
    } else {
      for (int w = 0; w < n; ++w)
        to[w].v = c[w] - a[w] * b[w];
    }
    return;
  }
  switch (o.op) {
    case Operator::add:
      return two([](const Lanes& p, const Lanes& q) DIPTYCH_INLINE_LAMBDA { return p + q; });
    case Operator::subtract:
      return two([](const Lanes& p, const Lanes& q) DIPTYCH_INLINE_LAMBDA { return p - q; });
    case Operator::multiply:
      return two([](const Lanes& p, const Lanes& q) DIPTYCH_INLINE_LAMBDA { return p * q; });
    case Operator::divide:
      return two([](const Lanes& p, const Lanes& q) DIPTYCH_INLINE_LAMBDA { return p / q; });
    case Operator::scale:
      return one([&](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return constant * p; });
    case Operator::shift:
      return one([&](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return constant + p; });
    case Operator::power:
      return one([&](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return constant_power(p, constant); });
    case Operator::sqrt:
      return one([](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return algebra::square_root(p); });
    case Operator::exp:
      return one([](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return algebra::exponential(p); });
    case Operator::sin:
    case Operator::cos: {
      LaneBlock* const also = registers + instruction.also * width_;
      for (int w = 0; w < n; ++w) {
        Lanes sine, cosine;
        algebra::sine_cosine(a[w], sine, cosine);
        to[w].v = o.op == Operator::sin ? sine : cosine;
        if (instruction.also >= 0) also[w].v = cosine;
      }
      return;
    }
    case Operator::abs:
      return one([](const Lanes& p) DIPTYCH_INLINE_LAMBDA { return algebra::magnitude(p); });
    case Operator::least:
      return two([](const Lanes& p, const Lanes& q)
                     DIPTYCH_INLINE_LAMBDA { return q < p ? q : p; });
    case Operator::greatest:
      return two([](const Lanes& p, const Lanes& q)
                     DIPTYCH_INLINE_LAMBDA { return q > p ? q : p; });
    case Operator::less:
      return two([](const Lanes& p, const Lanes& q) DIPTYCH_INLINE_LAMBDA { return truth(p < q); });
    case Operator::less_equal:
      return two([](const Lanes& p, const Lanes& q)
                     DIPTYCH_INLINE_LAMBDA { return truth(p <= q); });
    case Operator::equal:
      return two([](const Lanes& p, const Lanes& q)
                     DIPTYCH_INLINE_LAMBDA { return truth(p == q); });
    case Operator::differs:
      return two([](const Lanes& p, const Lanes& q)
                     DIPTYCH_INLINE_LAMBDA { return truth(p != q); });
    default:
      break;
  }
  const Blocks c = blocks(instruction.arguments[2], strip, scalars, registers);
  for (int w = 0; w < n; ++w)
    result_of_lanes(o, a[w], b[w], c[w], to[w].v);
}

DIPTYCH_CLONES void PlacedProgram::evaluate(std::int64_t strip,
                                            double t,
                                            const Instant& instant,
                                            Workspace& workspace) const {
  for (const GivenCall& given : calls_)
    call(given, strip, t, workspace);
  for (const Instruction& instruction : mixed_)
    run(instruction, strip, instant.data(), workspace.registers.data());
}

}  // namespace diptych::functions
