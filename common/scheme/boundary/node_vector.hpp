#pragma once
/// A vector field at one node.

#include "common/algebra/field.hpp"
#include "common/algebra/vectors.hpp"

namespace diptych::scheme {

/// In plane strain the third component is zero.
template <int Dim>
algebra::Vec3 vector_at(const algebra::BlockField& field, std::int64_t node) {
  algebra::Vec3 r = algebra::Vec3::Zero();
  for (int i = 0; i < Dim; ++i)
    r[i] = field.at(node, i);
  return r;
}

}  // namespace diptych::scheme
