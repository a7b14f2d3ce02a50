/// Case files: text to case, and what `explain` and the copy in the folder of a run make of it.

#include "common/cases/copy.hpp"
#include "common/cases/reader.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  return diptych::tests::take_or_refuse(data, size, [](const std::string& text) {
    const auto setup = diptych::cases::case_from_text(text, "case.toml");
    if (diptych::cases::case_copy(setup).empty()) __builtin_trap();
  });
}
