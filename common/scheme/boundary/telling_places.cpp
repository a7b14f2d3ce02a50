#include "common/scheme/boundary/telling_places.hpp"

#include <algorithm>
#include <limits>

namespace diptych::scheme {

void add_telling_places(std::span<const Vec3> X, std::vector<Vec3>& places) {
  constexpr int n_places = 10;
  if (X.empty()) return;
  std::vector<double> distance(X.size(), std::numeric_limits<double>::infinity());
  const auto measure = [&](const Vec3& place) {
    for (size_t a = 0; a < X.size(); ++a)
      distance[a] = std::min(distance[a], (X[a] - place).squaredNorm());
  };
  const auto add = [&](const Vec3& place) {
    places.push_back(place);
    measure(place);
  };
  for (const Vec3& place : places)
    measure(place);
  for (int d = 0; d < 3; ++d) {
    const auto [least, greatest] = std::minmax_element(
        X.begin(), X.end(), [d](const Vec3& a, const Vec3& b) { return a[d] < b[d]; });
    for (const auto& outermost : {least, greatest})
      if (distance[static_cast<size_t>(outermost - X.begin())] > 0) add(*outermost);
  }
  for (int k = 0; k < n_places; ++k) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest == 0) return;
    add(X[static_cast<size_t>(farthest - distance.begin())]);
  }
}

}  // namespace diptych::scheme
