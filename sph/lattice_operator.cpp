#include "sph/lattice_operator.hpp"

#include "common/base/error.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace diptych::sph {

namespace {

using Exponents = std::array<int, 3>;
using Offset = LatticeOffset;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int layers = lattice_layers;
/// Conditions are numbers of the size of one.
constexpr double most_residual = 1e-10;

/// Of degrees 1 to `degree`, those of degree 1 first and in the order of the directions.
std::vector<Exponents> monomials(int dimension, int degree) {
  std::vector<Exponents> all;
  for (int total = 1; total <= degree; ++total) {
    for (int i = total; i >= 0; --i) {
      for (int j = total - i; j >= 0; --j) {
        const int k = total - i - j;
        if (dimension == 3 || k == 0) all.push_back({i, j, k});
      }
    }
  }
  return all;
}

double value(const Exponents& m, const Offset& o) {
  double product = 1;
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < m[d]; ++i)
      product *= o[d];
  }
  return product;
}

Offset sum_of(const Offset& a, const Offset& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Offset reversed(const Offset& o) {
  return {-o[0], -o[1], -o[2]};
}

double length_of(const Offset& o) {
  return std::sqrt(static_cast<double>(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]));
}

std::vector<Offset> offsets_within(double support, int dimension) {
  const int reach = static_cast<int>(std::ceil(support)) - 1, height = dimension == 3 ? reach : 0;
  std::vector<Offset> offsets;
  for (int k = -height; k <= height; ++k) {
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        const double r = length_of({i, j, k});
        if (r > 0 && r < support * (1 - 1e-12)) offsets.push_back({i, j, k});
      }
    }
  }
  return offsets;
}

int dimension_of(const std::array<int, 3>& n) {
  return n[2] == 1 ? 2 : 3;
}

/// x with the least x^T W^-1 x among those that meet Z x = r: W Z^T y with Z W Z^T y = r, whose
/// null space are the polynomials that r is orthogonal to. A shift that rounding would bring anyhow
/// makes it regular, and refinement takes its effect away.
Vector least_change(const Eigen::SparseMatrix<double>& Z, const Vector& W, const Vector& r) {
  constexpr double relative_shift = 1e-11;
  constexpr int n_rounds = 4;
  const Eigen::SparseMatrix<double> WZ = W.asDiagonal() * Z.transpose();
  Matrix S = Z * WZ;
  S.diagonal().array() += relative_shift * S.diagonal().maxCoeff();
  const Eigen::LLT<Eigen::Ref<Matrix>> factors(S);  // in its place
  Vector x = Vector::Zero(Z.cols());
  for (int round = 0; round < n_rounds; ++round)
    x += WZ * factors.solve(r - Z * x);
  return x;
}

/// @throws base::InputError where conditions are not met
void require_met(double residual, double kappa, const std::array<int, 3>& n) {
  if (residual <= most_residual) return;
  throw base::InputError(fmt::format(
      "sph.gradient = \"sbp\": sph.kappa = {:.4g} with this kernel does not give the nodes of a "
      "lattice of {} x {} x {} the neighbours that the conditions ask for (missed by {:.2g}); take "
      "kappa = 1.2 to 1.5, refine the mesh, or use sph.gradient = \"corrected\"",
      kappa, n[0], n[1], n[2], residual));
}

}  // namespace

/// The conditions on the rows of all nodes of a lattice, of each kind one.
class LatticeConditions {
 public:
  explicit LatticeConditions(const LatticeRows& rows)
      : rows_(rows),
        dimension_(dimension_of(rows.n_)),
        quadratics_(monomials(dimension_, 2)),
        n_conditions_(static_cast<int>(quadratics_.size()) + 1 + dimension_) {
    const std::vector<Offset> kinds = rows.kinds();
    r_ = Vector::Zero(static_cast<int>(kinds.size()) * n_conditions_);
    int first = 0;
    for (const Offset& kind : kinds) {
      add_node(kind, first);
      first += n_conditions_;
    }
  }

  /// Changes the rows near sides. @return what is left of the conditions
  double meet(LatticeRows& rows) {
    Eigen::SparseMatrix<double> Z(static_cast<int>(r_.size()), static_cast<int>(unknown_.size()));
    Z.setFromTriplets(entries_.begin(), entries_.end());
    Vector W(static_cast<int>(unknown_.size()));
    for (const auto& [at, column] : unknown_)
      W[column] = rows.weight_[at];
    const Vector x = least_change(Z, W, r_);
    for (const auto& [at, column] : unknown_)
      rows.C_[at] += x[column];
    return (r_ - Z * x).cwiseAbs().maxCoeff();
  }

 private:
  /// C of the pair that begins at `node` counts `factor` times in condition `row`.
  void add(int row, double factor, const Offset& node, const Offset& o) {
    const Offset kind = rows_.common_kind(node, o);
    const auto [at, sign] = rows_.slot(kind, o);
    factor *= sign;
    if (factor == 0) return;
    r_[row] -= factor * rows_.C_[at];
    if (rows_.is_inside(kind)) return;
    const auto column = unknown_.emplace(at, static_cast<int>(unknown_.size())).first->second;
    entries_.emplace_back(row, column, factor);
  }

  void add_node(const Offset& node, int first) {
    const int closure = first + static_cast<int>(quadratics_.size());
    double Omega = 1;
    for (int d = 0; d < dimension_; ++d)
      Omega *= rows_.weight_at(d, node[d]);
    const double side = Omega / rows_.weight_at(0, node[0]);
    r_[first] += Omega;
    r_[closure + 1] += Omega;
    if (node[0] == 0) r_[closure] += side;  // -A_aN_a; no kind is at the far side
    for (const Offset& o : rows_.offsets_) {
      const Offset b = sum_of(node, o);
      if (!is_on_lattice(b)) continue;
      for (size_t m = 0; m < quadratics_.size(); ++m)
        add(first + static_cast<int>(m), 0.5 * value(quadratics_[m], o), node, o);
      add(closure, 0.5, node, o);
      add(closure, -0.5, b, reversed(o));
      for (int d = 0; d < dimension_; ++d)
        add(closure + 1 + d, -0.5 * o[d], b, reversed(o));
    }
  }

  /// Long lines are seen from their near ends.
  bool is_on_lattice(const Offset& node) const {
    for (int d = 0; d < 3; ++d) {
      if (node[d] < 0 || (!rows_.is_long(d) && node[d] >= rows_.n_[d])) return false;
    }
    return true;
  }

  const LatticeRows& rows_;
  int dimension_;
  std::vector<Exponents> quadratics_;
  int n_conditions_;
  std::map<size_t, int> unknown_;
  std::vector<Eigen::Triplet<double>> entries_;
  Vector r_;  ///< what the conditions ask for beyond the C that are there
};

double lattice_weight(int i, int n) {
  constexpr std::array<double, 3> correction{-5.0 / 8, 1.0 / 6, -1.0 / 24};
  double weight = 1;
  for (const int from_end : {i, n - 1 - i}) {
    if (from_end < static_cast<int>(correction.size())) weight += correction[from_end];
  }
  return weight;
}

LatticeRows::LatticeRows(const Kernel& kernel,
                         double kappa,
                         const std::vector<Offset>& offsets,
                         const std::array<int, 3>& n)
    : offsets_(offsets), n_(n) {
  number_offsets();
  set_inside(kernel, kappa);
  require_met(LatticeConditions(*this).meet(*this), kappa, n);
}

bool LatticeRows::is_long(int d) const {
  return n_[d] >= 2 * layers;
}

int LatticeRows::n_kinds(int d) const {
  return is_long(d) ? layers + 1 : (n_[d] + 1) / 2;
}

bool LatticeRows::is_own_mirror_image(const Offset& kind, int d) const {
  return is_long(d) ? kind[d] == layers : 2 * kind[d] == n_[d] - 1;
}

std::vector<Offset> LatticeRows::kinds() const {
  std::vector<Offset> all;
  for (int k = 0; k < n_kinds(2); ++k) {
    for (int j = 0; j < n_kinds(1); ++j) {
      for (int i = 0; i < n_kinds(0); ++i)
        all.push_back({i, j, k});
    }
  }
  return all;
}

Offset LatticeRows::common_kind(const Offset& node, const Offset& offset) const {
  Offset kind = node;
  for (int d = 0; d < 3; ++d) {
    if (is_long(d) && (node[d] >= layers || node[d] + offset[d] >= layers)) kind[d] = layers;
  }
  return kind;
}

bool LatticeRows::is_inside(const Offset& kind) const {
  for (int d = 0; d < dimension_of(n_); ++d) {
    if (!is_long(d) || kind[d] != layers) return false;
  }
  return true;
}

/// Of a long line: near its near side.
double LatticeRows::weight_at(int d, int place) const {
  return lattice_weight(place, is_long(d) ? place + 2 * layers : n_[d]);
}

size_t LatticeRows::first_of(const Offset& kind) const {
  return static_cast<size_t>((kind[2] * n_kinds(1) + kind[1]) * n_kinds(0) + kind[0]) *
         offsets_.size();
}

/// A search among the offsets for every pair would take longer than all the rest of a graph.
void LatticeRows::number_offsets() {
  for (const Offset& o : offsets_) {
    for (const int component : o)
      reach_ = std::max(reach_, std::abs(component));
  }
  const auto side = static_cast<size_t>(2 * reach_ + 1);
  numbers_.assign(side * side * side, static_cast<int>(offsets_.size()));
  for (size_t k = 0; k < offsets_.size(); ++k)
    numbers_[place_in_table(offsets_[k])] = static_cast<int>(k);
}

size_t LatticeRows::place_in_table(const Offset& offset) const {
  const int side = 2 * reach_ + 1;
  return static_cast<size_t>(((offset[2] + reach_) * side + offset[1] + reach_) * side + offset[0] +
                             reach_);
}

LatticeRows::Slot LatticeRows::slot(const Offset& place, const Offset& offset) const {
  Offset kind = place, o = offset;
  double sign = 1;
  for (int d = 0; d < 3; ++d) {
    const bool is_own = is_own_mirror_image(kind, d);
    const bool is_turned = is_own ? o[d] < 0 : kind[d] >= n_kinds(d);
    if (d == 0) sign = is_turned ? -1 : is_own && o[0] == 0 ? 0 : 1;
    if (!is_turned) continue;
    o[d] = -o[d];
    if (!is_own) kind[d] = n_[d] - 1 - kind[d];
  }
  return {first_of(kind) + static_cast<size_t>(numbers_[place_in_table(o)]), sign};
}

/// The gradient of the kernel, changed least to be exact for cubics, times the volumes of both
/// nodes as far as sides that both are near to make them.
void LatticeRows::set_inside(const Kernel& kernel, double kappa) {
  const int dimension = dimension_of(n_);
  const std::vector<Exponents> cubics = monomials(dimension, 3);
  const auto n = static_cast<int>(offsets_.size());
  Matrix Z(cubics.size(), n);
  Vector C(n), W(n), wanted = Vector::Zero(static_cast<int>(cubics.size()));
  for (int k = 0; k < n; ++k) {
    const Offset& o = offsets_[k];
    const double r = length_of(o);
    W[k] = kernel.value(r, kappa, dimension);
    C[k] = -kernel.slope(r, kappa, dimension) / r * o[0];
    for (size_t m = 0; m < cubics.size(); ++m)
      Z(static_cast<int>(m), k) = 0.5 * value(cubics[m], o);
  }
  C /= Z.row(0).dot(C);
  wanted[0] = 1;
  const Matrix S = Z * W.asDiagonal() * Z.transpose();
  C += W.asDiagonal() * Z.transpose() * S.completeOrthogonalDecomposition().solve(wanted - Z * C);
  require_met((wanted - Z * C).cwiseAbs().maxCoeff(), kappa, n_);

  for (const Offset& kind : kinds()) {
    for (int k = 0; k < n; ++k) {
      const Offset b = sum_of(kind, offsets_[k]);
      double volumes = 1, images = 1;
      for (int d = 0; d < dimension; ++d) {
        // what a short line has once beside what its two halves have twice
        if (!is_long(d) && is_own_mirror_image(kind, d) && offsets_[k][d] == 0) images *= 0.5;
        if (b[d] < 0 || b[d] >= (is_long(d) ? layers : n_[d]) || (is_long(d) && kind[d] == layers))
          continue;
        volumes *= weight_at(d, kind[d]) * weight_at(d, b[d]);
      }
      C_.push_back(C[k] * volumes);
      weight_.push_back(W[k] * volumes / images);
    }
  }
}

double LatticeRows::C(const Offset& node, const Offset& offset) const {
  const Slot found = slot(common_kind(node, offset), offset);
  return found.sign * C_[found.at];
}

LatticeOperator::LatticeOperator(const Kernel& kernel, double kappa, const std::array<int, 3>& n)
    : offsets_(offsets_within(kernel.support * kappa, dimension_of(n))), n_(n) {
  std::vector<std::array<int, 3>> made;
  for (int d = 0; d < dimension_of(n); ++d) {
    std::array<int, 3> turned = n;
    for (int& nodes : turned)
      nodes = std::min(nodes, 2 * layers);
    std::swap(turned[0], turned[d]);
    const auto found = std::find(made.begin(), made.end(), turned);
    rows_of_[d] = static_cast<int>(found - made.begin());
    if (found == made.end()) made.push_back(turned);
  }
  for (const auto& turned : made)
    rows_.emplace_back(kernel, kappa, offsets_, turned);
}

Vec3 LatticeOperator::C(const Offset& place, const Offset& offset) const {
  // seen from the far end of a line offsets and components turn round
  Offset node = place, o = offset;
  Vec3 turn = Vec3::Ones(), C = Vec3::Zero();
  const int dimension = dimension_of(n_);
  for (int d = 0; d < dimension; ++d) {
    const int from_end = n_[d] - 1 - place[d];
    if (n_[d] < 2 * layers || place[d] <= from_end) continue;
    node[d] = from_end;
    o[d] = -o[d];
    turn[d] = -1;
  }
  for (int d = 0; d < dimension; ++d) {
    Offset node_d = node, o_d = o;
    std::swap(node_d[0], node_d[d]);
    std::swap(o_d[0], o_d[d]);
    C[d] = turn[d] * rows_[static_cast<size_t>(rows_of_[d])].C(node_d, o_d);
  }
  return C;
}

}  // namespace diptych::sph
