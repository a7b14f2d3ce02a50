#include "common/closure/class_repair.hpp"

#include "common/closure/closure_gap.hpp"
#include "common/scheme/graph/classify_rows.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <optional>

namespace diptych::closure {

namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixX3d;

/// Beyond these the repair by pairs is the cheaper one: the dense system takes seconds. Classes
/// that also tell neighbours apart, ring by ring, spread the change farther: smaller errors
/// (swinging cube with face correction, kappa 1.0, 1/32: u 7.5e-4, 5.4e-4, 4.5e-4), more
/// conditions.
constexpr double most_classes_per_node = 0.75;
constexpr Index most_conditions = 5000, most_conditions_of_rings = 2000;

/// What rounding leaves of S along its null space, relative to its diagonal.
constexpr double regularisation = 1e-12;

/// Gaps that are rounding.
constexpr double least_gap = 1e-12;

constexpr int most_rings = 2, most_passes = 4, most_refinements = 8;

/// Rows of one class and what changes of them.
struct ClassOfRows {
  std::int64_t node = -1;  ///< one of the class
  // of those that may change only
  Eigen::Matrix3d inverse;  ///< pseudo-inverse of M_c
  MatrixX3d X;              ///< [pairs]
  Eigen::VectorXd k;        ///< [pairs]
  Matrix3Xd step, change;   ///< [pairs] dC of the last pass and of all
  /// (condition, pair, +-1/2): how dC enters the conditions.
  struct Entry {
    Index condition;
    int pair;
    double factor;
  };
  std::vector<Entry> entries;
};

class ClassRepair {
 public:
  /// @param gap  closure_gap(graph)
  ClassRepair(scheme::PairGraph& graph, const scheme::RowClasses& rows, const Field& gap)
      : graph_(graph), rows_(rows), unit_(area_units(graph)), gap_(gap) {
    find_free_classes();
    find_conditions();
  }

  Index n_conditions() const { return static_cast<Index>(node_of_.size()); }

  /// @return whether the graph is closed now; it is left as it was, up to rounding, where not
  bool repair(const PairWeight& k, const RepairLimits& limits) {
    for (ClassOfRows& c : classes_)
      if (is_free(c.node)) set_geometry(k, c);
    for (Index e = 0; e < n_conditions(); ++e)
      add_entries(e, node_of_[static_cast<size_t>(e)]);
    set_system();
    double before = greatest(gap_, unit_);
    for (int pass = 0; pass < most_passes && !(before <= limits.closure); ++pass) {
      solve();
      add_to_rows(1, &ClassOfRows::step);
      update_closure_gap(graph_, touched_, gap_);
      const double after = greatest(gap_, unit_);
      const bool halved = after < 0.5 * before;
      before = after;
      if (!halved) break;
    }
    if (before <= limits.closure) return true;
    add_to_rows(-1, &ClassOfRows::change);
    return false;
  }

 private:
  std::int64_t length(std::int64_t a) const { return graph_.row[a + 1] - graph_.row[a]; }
  std::int64_t pair(std::int64_t a, std::int64_t k) const { return rows_.pair(graph_.row[a], k); }
  std::int32_t class_of(std::int64_t a) const { return rows_.rows.of[a]; }

  /// Classes may change where all of their nodes have a gap.
  void find_free_classes() {
    classes_.resize(rows_.rows.representative.size());
    for (size_t c = 0; c < classes_.size(); ++c)
      classes_[c].node = rows_.rows.representative[c];
    free_.assign(classes_.size(), 1);
    for (std::int64_t a = 0; a < graph_.n_nodes(); ++a) {
      if (gap_[a].norm() * unit_[a] < least_gap) free_[class_of(a)] = 0;
    }
  }

  void set_geometry(const PairWeight& k, ClassOfRows& c) const {
    const auto n = static_cast<Index>(length(c.node));
    c.X.resize(n, 3);
    c.k.resize(n);
    for (Index i = 0; i < n; ++i) {
      const std::int64_t p = pair(c.node, i);
      c.X.row(i) = (graph_.X[graph_.neighbour[p]] - graph_.X[c.node]).transpose();
      c.k[i] = k(c.node, p);
    }
    c.change = Matrix3Xd::Zero(3, n);
    const Eigen::Matrix3d M = c.X.transpose() * c.k.asDiagonal() * c.X;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(M);
    Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      if (of.eigenvalues()[i] > 1e-10 * of.eigenvalues()[2]) inverse[i] = 1 / of.eigenvalues()[i];
    }
    c.inverse = of.eigenvectors() * inverse.asDiagonal() * of.eigenvectors().transpose();
  }

  bool is_free(std::int64_t a) const { return free_[class_of(a)] != 0; }

  /// Nodes with the same row, area and neighbours have the same condition; those that nothing
  /// changes have none.
  void find_conditions() {
    std::vector<std::uint64_t> hash(gap_.size());
    touched_.assign(gap_.size(), 0);
    for_each_node(gap_.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        scheme::Hash h;
        h.add(static_cast<std::uint64_t>(class_of(a)));
        for (int i = 0; i < 3; ++i) {
          const double area = graph_.boundary_area[a][i] * unit_[a];
          h.add(static_cast<std::uint64_t>(std::llround(area * 1e6 + 0.2718)));
        }
        bool touched = is_free(a);
        for (std::int64_t k = 0; k < length(a); ++k) {
          const std::int32_t b = graph_.neighbour[pair(a, k)];
          h.add(static_cast<std::uint64_t>(class_of(b)));
          touched |= is_free(b);
        }
        touched_[a] = touched;
        hash[a] = h.value();
      }
    });
    const scheme::EqualGroups kinds =
        scheme::group_equal(hash, [](std::int32_t, std::int32_t) { return true; });
    for (const std::int32_t a : kinds.representative)
      if (touched_[a]) node_of_.push_back(a);
  }

  void add_entries(Index e, std::int64_t a) {
    const auto add = [&](std::int64_t node, std::int64_t p, double factor) {
      if (is_free(node))
        classes_[class_of(node)].entries.push_back(
            {e, static_cast<int>(rows_.place_of(graph_.row[node], p)), factor});
    };
    for (std::int64_t p = graph_.row[a]; p < graph_.row[a + 1]; ++p) {
      add(a, p, 0.5);
      add(graph_.neighbour[p], graph_.reverse(p), -0.5);
    }
  }

  /// S = sum_c B_c (K - K X M^+ X^T K) B_c^T
  void set_system() {
    const Index n = n_conditions();
    S_ = Eigen::MatrixXd::Zero(n, n);
    for (const ClassOfRows& c : classes_) {
      if (!is_free(c.node)) continue;
      std::vector<Index> conditions;
      for (const auto& entry : c.entries)
        conditions.push_back(entry.condition);
      std::sort(conditions.begin(), conditions.end());
      conditions.erase(std::unique(conditions.begin(), conditions.end()), conditions.end());
      const auto m = static_cast<Index>(conditions.size());
      Eigen::MatrixXd B = Eigen::MatrixXd::Zero(m, c.k.size());
      for (const auto& entry : c.entries) {
        const auto at = std::lower_bound(conditions.begin(), conditions.end(), entry.condition);
        B(at - conditions.begin(), entry.pair) += entry.factor;
      }
      const Eigen::MatrixXd BK = B * c.k.asDiagonal(), BKX = BK * c.X;
      const Eigen::MatrixXd part = BK * B.transpose() - BKX * c.inverse * BKX.transpose();
      for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < m; ++j)
          S_(conditions[static_cast<size_t>(i)], conditions[static_cast<size_t>(j)]) += part(i, j);
      }
    }
    positive_ = S_;
    positive_.diagonal().array() += regularisation * S_.diagonal().maxCoeff();
    factor_.emplace(positive_);
  }

  /// Solves for the gaps: the step of each class.
  void solve() {
    MatrixX3d r(n_conditions(), 3);
    for (Index e = 0; e < r.rows(); ++e)
      r.row(e) = -gap_[node_of_[static_cast<size_t>(e)]].transpose();
    const MatrixX3d wanted = r;
    MatrixX3d y = MatrixX3d::Zero(r.rows(), 3);
    double left = wanted.norm();
    for (int i = 0; i < most_refinements; ++i) {
      const MatrixX3d next = y + factor_->solve(r);
      const MatrixX3d r_next = wanted - S_ * next;
      if (!(r_next.norm() < 0.5 * left)) break;
      left = r_next.norm();
      y = next;
      r = r_next;
    }
    for (ClassOfRows& c : classes_) {
      if (!is_free(c.node)) continue;
      MatrixX3d z = MatrixX3d::Zero(c.k.size(), 3);
      for (const auto& entry : c.entries)
        z.row(entry.pair) += entry.factor * y.row(entry.condition);
      const Eigen::Matrix3d slope = c.inverse * (c.X.transpose() * c.k.asDiagonal() * z);
      c.step = (c.k.asDiagonal() * (z - c.X * slope)).transpose();
      c.change += c.step;
    }
  }

  /// C += sign * change of the rows, where they may change.
  void add_to_rows(double sign, Matrix3Xd ClassOfRows::*change) {
    std::vector<scheme::Vec3>& C = graph_.C.each();
    for_each_node(gap_.size(), [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        if (!is_free(a)) continue;
        const Matrix3Xd& dC = classes_[static_cast<size_t>(class_of(a))].*change;
        for (std::int64_t k = 0; k < length(a); ++k)
          C[pair(a, k)] += sign * dC.col(k);
      }
    });
  }

  scheme::PairGraph& graph_;
  const scheme::RowClasses& rows_;
  std::vector<double> unit_;
  Field gap_;
  std::vector<ClassOfRows> classes_;
  std::vector<char> free_;             ///< [classes] whether their rows may change
  std::vector<char> touched_;          ///< [nodes] whether anything changes their gap
  std::vector<std::int64_t> node_of_;  ///< [conditions] a node of each kind
  Eigen::MatrixXd S_, positive_;       ///< S, and regularised, where its factor takes its place
  std::optional<Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>> factor_;
};

}  // namespace

bool repair_closure_by_classes(scheme::PairGraph& graph,
                               const PairWeight& k,
                               const RepairLimits& limits) {
  scheme::RowClasses rows = scheme::classify_rows(graph);
  const auto n_classes = static_cast<double>(rows.rows.representative.size());
  if (n_classes > most_classes_per_node * static_cast<double>(graph.n_nodes())) return false;
  const Field gap = closure_gap(graph);
  const auto closes = [&](Index most) {
    ClassRepair repair(graph, rows, gap);
    if (repair.n_conditions() > most) return false;
    return repair.repair(k, limits);
  };
  std::vector<scheme::EqualGroups> choices{rows.rows};
  for (int ring = 1; ring <= most_rings; ++ring) {
    rows.rows = scheme::group_by_neighbours(graph, rows, false);
    choices.push_back(rows.rows);
  }
  for (size_t rings = choices.size(); rings-- > 0;) {
    rows.rows = choices[rings];
    if (!closes(rings > 0 ? most_conditions_of_rings : most_conditions)) continue;
    // what was equal has been changed in the same way
    if (rows.order.empty()) scheme::set_classes(graph, rows.rows);
    return true;
  }
  return false;
}

}  // namespace diptych::closure
