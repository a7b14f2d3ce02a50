#pragma once
/// Sets of numbers that have been joined, such as faces of one surface.
/// Test: tests/meshes/cavities_test.cpp

#include <cstdint>
#include <numeric>
#include <vector>

namespace diptych::meshes {

class Joined {
 public:
  explicit Joined(std::int64_t n) : parent_(static_cast<size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// The number that stands for the set of a.
  std::int32_t of(std::int32_t a) {
    while (parent_[a] != a)
      a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[of(b)] = of(a); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace diptych::meshes
