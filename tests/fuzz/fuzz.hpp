#pragma once
/// What all fuzz targets share: input is refused with an error of the program's own, or taken; any
/// other exception, and what the sanitizers and the limits of tests/fuzz/run find, is a failure.

#include "common/base/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace diptych::tests {

/// use(text): of the input. What is refused is refused.
template <class Use>
int take_or_refuse(const std::uint8_t* data, size_t size, const Use& use) {
  try {
    use(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const base::Error& refused) {
    if (refused.what()[0] == '\0') __builtin_trap();  // a refusal says why
  }
  return 0;
}

}  // namespace diptych::tests
