#pragma once
/// Vectors at many places, of which each stands once where few are different: four bytes a place
/// in place of 24. Pairs of a lattice have a few hundred different C_ab and weights of slopes,
/// whatever the number of nodes. Test: tests/common/algebra/shared_vectors_test.cpp

#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace diptych::algebra {

class SharedVectors {
 public:
  using Numbers = std::vector<std::uint32_t>;

  SharedVectors() = default;
  /// One for every place.
  explicit SharedVectors(std::vector<Vec3> each) : values_(std::move(each)) {}
  /// @param number  [places] into values; not empty
  SharedVectors(std::vector<Vec3> values, Numbers number)
      : values_(std::move(values)), number_(std::move(number)) {}

  bool is_shared() const { return !number_.empty(); }
  std::size_t size() const { return is_shared() ? number_.size() : values_.size(); }
  const Vec3& operator[](std::int64_t place) const {
    return values_[is_shared() ? number_[static_cast<std::size_t>(place)]
                               : static_cast<std::size_t>(place)];
  }

  /// Place by place, whatever stands once.
  bool operator==(const SharedVectors& other) const {
    if (size() != other.size()) return false;
    for (std::int64_t place = 0; place < static_cast<std::int64_t>(size()); ++place)
      if ((*this)[place] != other[place]) return false;
    return true;
  }

  /// One for every place from now on, to be changed.
  std::vector<Vec3>& each() {
    if (!is_shared()) return values_;
    std::vector<Vec3> all;
    all.reserve(number_.size());
    for (const std::uint32_t number : number_)
      all.push_back(values_[number]);
    values_ = std::move(all);
    number_ = {};
    return values_;
  }

  /// From now on the same at `place` as at `other`.
  void put_as(std::int64_t place, std::int64_t other) {
    const auto at = static_cast<std::size_t>(place), from = static_cast<std::size_t>(other);
    if (is_shared()) {
      number_[at] = number_[from];
    } else {
      values_[at] = values_[from];
    }
  }

  /// Calls change(vector) once for each that stands here: the same change wherever it is meant.
  template <class Change>
  void change_alike(const Change& change) {
    for (Vec3& value : values_)
      change(value);
  }
  template <class Use>
  void for_each_alike(const Use& use) const {
    for (const Vec3& value : values_)
      use(value);
  }

 private:
  std::vector<Vec3> values_;
  Numbers number_;  ///< of each place; empty: its own
};

}  // namespace diptych::algebra
