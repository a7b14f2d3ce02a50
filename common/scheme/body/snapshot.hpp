#pragma once
/// The fields of a body as numbers of the host: what observers, errors and reports read.

#include "common/algebra/vectors.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace diptych::scheme {

using algebra::Mat3;
using algebra::Vec3;

class MaterialModel;
template <int Dim>
struct Body;

/// Nodal fields in the numbering of the graph.
struct Snapshot {
  double time = 0;
  std::vector<Vec3> u, v;               ///< m, m/s
  std::vector<Mat3> F, H, P;            ///< -, -, Pa
  std::vector<double> J;                ///< -
  std::vector<std::vector<Mat3>> A, S;  ///< [branch][node] C_v^-1, G_v^-1

  /// Of these of its nodes, in this order.
  Snapshot of(std::span<const std::int32_t> nodes) const;
};

/// Of these nodes, in this order; among ranks each works its own, and all have all.
template <int Dim>
Snapshot snapshot_of(const MaterialModel& material,
                     const Body<Dim>& body,
                     double time,
                     std::span<const std::int32_t> nodes);

/// Calls visit(chunk, first, fields) for the chunks of nodes of this rank, by all threads: fields
/// are those of the nodes from `first` on.
template <int Dim>
void visit_chunks(
    const MaterialModel& material,
    const Body<Dim>& body,
    double time,
    const std::function<void(std::int64_t chunk, std::int64_t first, const Snapshot&)>& visit);

/// Of all nodes, in the memory of an earlier one.
template <int Dim>
void take_snapshot(const MaterialModel& material,
                   const Body<Dim>& body,
                   double time,
                   Snapshot& snapshot);

}  // namespace diptych::scheme
