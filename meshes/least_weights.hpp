#pragma once
/// Weights of the nodes around a cell or a face that integrate polynomials as it does.
/// Test: tests/graphs/quadratic_measure_test.cpp

#include "common/algebra/vectors.hpp"
#include "meshes/mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych::meshes {

/// Nodes that were met since begin(), each once; one for each thread, since it is as long as the
/// mesh.
class MetNodes {
 public:
  void begin(size_t n_nodes) {
    if (met_.size() < n_nodes) met_.resize(n_nodes, 0);
    if (++now_ == 0) {
      std::fill(met_.begin(), met_.end(), 0U);
      now_ = 1;
    }
  }
  bool is_new(std::int32_t a) {
    const bool is_new = met_[a] != now_;
    met_[a] = now_;
    return is_new;
  }

 private:
  std::vector<std::uint32_t> met_;
  std::uint32_t now_ = 0;
};

/// These corners, the nodes that share a cell with one of them, and so on, until there are enough.
/// Ascending.
/// @param visit_sharing  visit_sharing(a, visit): visits the nodes that share a cell with node a
template <class VisitSharing>
std::vector<std::int32_t> surrounding(std::span<const std::int32_t> corners,
                                      size_t enough,
                                      size_t n_nodes,
                                      const VisitSharing& visit_sharing) {
  thread_local MetNodes met;
  met.begin(n_nodes);
  std::vector<std::int32_t> nodes;
  const auto add = [&](std::int32_t a) {
    if (met.is_new(a)) nodes.push_back(a);
  };
  for (const std::int32_t a : corners)
    add(a);
  size_t begin = 0;  // of those whose neighbours have not been looked at
  while (nodes.size() < enough && begin < nodes.size()) {
    const size_t end = nodes.size();
    for (; begin < end; ++begin)
      visit_sharing(nodes[begin], add);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Changes weights least, beside what a node has by the vertex rule, so that they integrate the
/// polynomials as `exact` does; where nodes are too few, or would change by half of their share,
/// those of a lower degree: the volume or the area stays at least.
/// @param at     [nodes] places from the middle, over h
/// @param share  [nodes] volume or area by that rule, in a unit of the size of the cell or the face
/// @param unit   that unit, in that of w
void meet_moments(const std::vector<Vec3>& at,
                  const std::vector<double>& share,
                  double unit,
                  int dimension,
                  int degree,
                  const Eigen::VectorXd& exact,
                  Eigen::VectorXd& w);

}  // namespace diptych::meshes
