#pragma once
/// Groups of equal things, in order of first appearance.

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace diptych::scheme {

struct EqualGroups {
  std::vector<std::int32_t> of;              ///< [n] group of each thing
  std::vector<std::int32_t> representative;  ///< [n_groups] the first thing of the group
};

/// @param hash   [n], equal for equal things
/// @param equal  of two indices
template <class Equal>
EqualGroups group_equal(const std::vector<std::uint64_t>& hash, const Equal& equal) {
  EqualGroups groups;
  groups.of.resize(hash.size());
  std::unordered_multimap<std::uint64_t, std::int32_t> known;
  for (std::size_t i = 0; i < hash.size(); ++i) {
    std::int32_t found = -1;
    const auto [begin, end] = known.equal_range(hash[i]);
    for (auto it = begin; it != end && found < 0; ++it) {
      if (equal(groups.representative[static_cast<std::size_t>(it->second)],
                static_cast<std::int32_t>(i))) {
        found = it->second;
      }
    }
    if (found < 0) {
      found = static_cast<std::int32_t>(groups.representative.size());
      groups.representative.push_back(static_cast<std::int32_t>(i));
      known.emplace(hash[i], found);
    }
    groups.of[i] = found;
  }
  return groups;
}

/// Groups of the things of `alike`, whose groups g are equal where groups.of[g] is the same.
inline EqualGroups joined(const EqualGroups& alike, const EqualGroups& groups) {
  EqualGroups all;
  all.of.reserve(alike.of.size());
  for (const std::int32_t group : alike.of)
    all.of.push_back(groups.of[static_cast<std::size_t>(group)]);
  for (const std::int32_t group : groups.representative)
    all.representative.push_back(alike.representative[static_cast<std::size_t>(group)]);
  return all;
}

/// Sixty-four bits of a sequence of words.
class Hash {
 public:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9E3779B97F4A7C15ULL;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 1469598103934665603ULL;
};

}  // namespace diptych::scheme
