#pragma once
/// Calls to the disk that fail within a test (failing_calls.cpp, linked into it).

namespace diptych::tests {

/// The n-th call from now that puts bytes or names on the disk fails, from 1; 0: none.
/// @param as  an errno as text, or "short": a write takes half of its bytes, and the next one
///            fails with ENOSPC
void fail_call(long at, const char* as = "5");

/// Since the last fail_call.
long n_calls_made();

}  // namespace diptych::tests
