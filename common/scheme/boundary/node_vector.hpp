#pragma once
/// A vector field at one node.

#include "common/algebra/field.hpp"
#include "common/algebra/lanes.hpp"
#include "common/algebra/vectors.hpp"
#include "common/scheme/body/node_chunks.hpp"

namespace diptych::scheme {

/// In plane strain the third component is zero.
/// @param field  block field or node table
template <int Dim, class Field>
DIPTYCH_INLINE algebra::Vec3 vector_at(const Field& field, std::int64_t node) {
  algebra::Vec3 r = algebra::Vec3::Zero();
  for (int i = 0; i < Dim; ++i)
    r[i] = field.at(node, i);
  return r;
}

/// A vector that begins with zero.
struct VectorSum {
  algebra::Vec3 value = algebra::Vec3::Zero();
  VectorSum& operator+=(const VectorSum& other) {
    value += other.value;
    return *this;
  }
};

}  // namespace diptych::scheme
