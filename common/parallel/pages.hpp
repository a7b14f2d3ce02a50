#pragma once
/// Memory that a rank has no more use for, inside of arrays that stay where they are: its pages go
/// back to the system. Test: tests/common/parallel/pages_test.cpp, tests/ranks

#include <cstddef>
#include <cstdint>
#include <string>

namespace diptych::parallel {

/// Gives back the whole pages inside of [begin, begin + n), n in bytes: nobody reads them until
/// they have been written again. With DIPTYCH_RANK_MEMORY=poisoned in the environment all bytes are
/// set to 0xff instead, numbers that are none and indices below zero, for tests: whoever reads them
/// is found out. From now on no huge page is made where one would hold some of it and something
/// else: it would bring back what is given.
/// @pre memory of the heap  @throws base::InputError on another value
void give_back(std::byte* begin, std::int64_t n);

/// A line of /proc/self/status, such as "VmHWM:", the largest resident set, in bytes.
std::int64_t status_bytes(const std::string& key);

/// Resident set once what has been freed has gone back to the system, in bytes.
std::int64_t settled_bytes();

}  // namespace diptych::parallel
