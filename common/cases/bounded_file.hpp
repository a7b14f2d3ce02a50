#pragma once
/// A text file read as a whole, of bounded size. Test: tests/common/cases/hostile_cases_test.cpp.

#include <cstddef>
#include <string>

namespace diptych::cases {

/// @param most_bytes  the file is not read where it has more
/// @param what        "a case file", for messages
/// @throws base::InputError on what is no regular file (a device or a pipe has no end) or too
///         long, base::EnvironmentError where it cannot be read
std::string bounded_file(const std::string& path, size_t most_bytes, const std::string& what);

}  // namespace diptych::cases
