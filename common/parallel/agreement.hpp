#pragma once
/// Where one rank alone may fail, all are to know it before they wait for each other.
/// Test: tests/common/parallel/partition_test.cpp

#include "common/parallel/communicator.hpp"

#include <exception>

namespace diptych::parallel {

/// Called by all ranks together: all go on, or all throw.
/// @param error  what this rank met, or null
/// @throws that; where only others met something, an error of the same kind as the first of these
///         that says which rank it was
void agree(Communicator& ranks, const std::exception_ptr& error);

/// The same of what work() throws.
template <class Work>
void agree_on(Communicator& ranks, const Work& work) {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  agree(ranks, error);
}

}  // namespace diptych::parallel
