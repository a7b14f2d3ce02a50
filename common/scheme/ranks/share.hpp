#pragma once
/// Inner and outer work of a rank. Test: tests/ranks

namespace diptych::scheme {

/// What of a rank's work a sweep does.
enum class Share {
  whole,
  inner,  ///< what reads no node of another rank
  outer   ///< the rest; after inner
};

}  // namespace diptych::scheme
