#pragma once
/// The fields at one node under the names that expressions of probes use.

#include "common/functions/expressions.hpp"

namespace diptych::cases {

using algebra::Mat3;
using algebra::Vec3;

/// What probes read of a node.
struct NodeValues {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();      ///< m, m/s
  Mat3 F = Mat3::Identity(), P = Mat3::Zero();  ///< -, Pa
  double J = 1;
};

/// ux ... vz, Fxx ... Fzz, Pxx ... Pzz, sxx ... (Cauchy stress P F^T/J), mises, p, J.
class ProbeFields : public functions::TimeFunction {
 public:
  std::vector<std::string> names() const override;
  /// Of the node set last.
  std::vector<double> values(double t) const override;
  bool depends_on_position() const override { return true; }  // else expressions would not ask
  void set(const NodeValues& node) { node_ = node; }

  /// @throws base::InputError where a parameter or function has the name of a field
  void check_names(const functions::Vocabulary& vocabulary,
                   const functions::SourcePlace& where) const;

 private:
  NodeValues node_;
};

}  // namespace diptych::cases
