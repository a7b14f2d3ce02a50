/// Expressions: text to function, evaluated at places and times.

#include "common/functions/expressions.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  return diptych::tests::take_or_refuse(data, size, [](const std::string& text) {
    const diptych::functions::Vocabulary words{{{"omega", 6.0}, {"L", 2.0}}, {}};
    const diptych::functions::Expression f(text, words, {"case.toml", 1, 1});
    const double here = f({0.5, -1, 2}, 0.25);
    if (f({0, 0, 0}, 0) != f({0, 0, 0}, 0)) __builtin_trap();  // not a number is refused
    if (here != f({0.5, -1, 2}, 0.25)) __builtin_trap();       // pure
  });
}
