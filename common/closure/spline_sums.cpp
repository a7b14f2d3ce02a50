#include "common/closure/spline_sums.hpp"

#include "common/algebra/lanes.hpp"

#include <algorithm>

namespace diptych::closure {

namespace {

/// Children of spline j that the fine grid has: [begin, end) of the weights, from spline `from` on.
struct Children {
  int begin, end, from;
};

DIPTYCH_INLINE Children children_of(const Refinement& to, int j, int n) {
  const int first = to.factor * j + to.first;
  return {std::max(0, -first), std::min(static_cast<int>(to.weight.size()), n - first), first};
}

}  // namespace

DIPTYCH_CLONES void restrict_plane(const Refinements& to,
                                   const SplineIndex& n_fine,
                                   const Four* fine,
                                   const SplineIndex& n_coarse,
                                   int z,
                                   Four* coarse) {
  const auto& [in_x, in_y, in_z] = to;
  const Children cz = children_of(in_z, z, n_fine[2]);
  Four* of_plane = coarse + static_cast<std::int64_t>(z) * n_coarse[1] * n_coarse[0];
  for (int y = 0; y < n_coarse[1]; ++y) {
    const Children cy = children_of(in_y, y, n_fine[1]);
    for (int x = 0; x < n_coarse[0]; ++x) {
      const Children cx = children_of(in_x, x, n_fine[0]);
      Four sum{};
      for (int k = cz.begin; k < cz.end; ++k) {
        for (int j = cy.begin; j < cy.end; ++j) {
          const Four* line =
              fine +
              (static_cast<std::int64_t>(cz.from + k) * n_fine[1] + cy.from + j) * n_fine[0] +
              cx.from;
          Four along{};
          for (int i = cx.begin; i < cx.end; ++i)
            along += in_x.weight[i] * line[i];
          sum += in_z.weight[k] * in_y.weight[j] * along;
        }
      }
      of_plane[static_cast<std::int64_t>(y) * n_coarse[0] + x] += sum;
    }
  }
}

DIPTYCH_CLONES void refine_plane(const Refinements& to,
                                 const SplineIndex& n_coarse,
                                 const Four* coarse,
                                 const SplineIndex& n_fine,
                                 int z,
                                 Four* fine) {
  const auto& [in_x, in_y, in_z] = to;
  Four* of_plane = fine + static_cast<std::int64_t>(z) * n_fine[1] * n_fine[0];
  for (int Z = 0; Z < n_coarse[2]; ++Z) {
    const Children cz = children_of(in_z, Z, n_fine[2]);
    const int k = z - cz.from;
    if (k < cz.begin || k >= cz.end) continue;
    for (int Y = 0; Y < n_coarse[1]; ++Y) {
      const Children cy = children_of(in_y, Y, n_fine[1]);
      const Four* line = coarse + (static_cast<std::int64_t>(Z) * n_coarse[1] + Y) * n_coarse[0];
      for (int j = cy.begin; j < cy.end; ++j) {
        const double across = in_z.weight[k] * in_y.weight[j];
        Four* of_line = of_plane + static_cast<std::int64_t>(cy.from + j) * n_fine[0];
        for (int X = 0; X < n_coarse[0]; ++X) {
          const Children cx = children_of(in_x, X, n_fine[0]);
          const Four value = across * line[X];
          for (int i = cx.begin; i < cx.end; ++i)
            of_line[cx.from + i] += in_x.weight[i] * value;
        }
      }
    }
  }
}

DIPTYCH_CLONES void spread_nodes(const std::int32_t* begin,
                                 const std::int32_t* end,
                                 const NodeSplines<quadratic>* splines,
                                 const SplineIndex& n,
                                 int n_z,
                                 const Vec3* r,
                                 Four* grid) {
  for (; begin != end; ++begin) {
    const NodeSplines<quadratic>& s = splines[*begin];
    const Four field = algebra::load_three(r[*begin]);
    for (int k = 0; k < n_z; ++k) {
      for (int j = 0; j <= quadratic; ++j) {
        const Four w = s.value[2][k] * s.value[1][j] * field;
        Four* g = grid + s.first + (static_cast<std::int64_t>(k) * n[1] + j) * n[0];
        for (int i = 0; i <= quadratic; ++i)
          g[i] += s.value[0][i] * w;
      }
    }
  }
}

DIPTYCH_CLONES void gather_nodes(std::int64_t begin,
                                 std::int64_t end,
                                 const NodeSplines<quadratic>* splines,
                                 const SplineIndex& n,
                                 int n_z,
                                 const Four* grid,
                                 Vec3* z) {
  for (std::int64_t a = begin; a < end; ++a) {
    const NodeSplines<quadratic>& s = splines[a];
    Four sum = algebra::load_three(z[a]);
    for (int k = 0; k < n_z; ++k) {
      for (int j = 0; j <= quadratic; ++j) {
        const Four* g = grid + s.first + (static_cast<std::int64_t>(k) * n[1] + j) * n[0];
        sum += s.value[2][k] * s.value[1][j] *
               (s.value[0][0] * g[0] + s.value[0][1] * g[1] + s.value[0][2] * g[2]);
      }
    }
    algebra::store_three(z[a].data(), sum);
  }
}

DIPTYCH_CLONES void spread_nodes_with_slopes(const std::int32_t* begin,
                                             const std::int32_t* end,
                                             const NodeSplines<quartic>* splines,
                                             const NodeSlopes<quartic>* slopes,
                                             const SplineIndex& n,
                                             int d,
                                             const Vec3* r,
                                             Four* grid) {
  for (; begin != end; ++begin) {
    const NodeSplines<quartic>& s = splines[*begin];
    const NodeSlopes<quartic>& g = slopes[*begin];
    const Vec3* of_node = r + static_cast<std::int64_t>(*begin) * (1 + d);
    const Four field = algebra::load_three(of_node[0]), by_x = algebra::load_three(of_node[1]),
               by_y = algebra::load_three(of_node[2]),
               by_z = d == 3 ? algebra::load_three(of_node[3]) : Four{};
    for (int k = 0; k < (d == 3 ? quartic + 1 : 1); ++k) {
      for (int j = 0; j <= quartic; ++j) {
        const double z = s.value[2][k], y = s.value[1][j];
        const Four across = z * y * field + z * g.value[1][j] * by_y + g.value[2][k] * y * by_z;
        const Four along = z * y * by_x;
        Four* place = grid + s.first + (static_cast<std::int64_t>(k) * n[1] + j) * n[0];
        for (int i = 0; i <= quartic; ++i)
          place[i] += s.value[0][i] * across + g.value[0][i] * along;
      }
    }
  }
}

DIPTYCH_CLONES void gather_nodes_with_slopes(std::int64_t begin,
                                             std::int64_t end,
                                             const NodeSplines<quartic>* splines,
                                             const NodeSlopes<quartic>* slopes,
                                             const SplineIndex& n,
                                             int d,
                                             const Four* grid,
                                             Vec3* z) {
  for (std::int64_t a = begin; a < end; ++a) {
    const NodeSplines<quartic>& s = splines[a];
    const NodeSlopes<quartic>& g = slopes[a];
    Four sum{}, by[3]{};
    for (int k = 0; k < (d == 3 ? quartic + 1 : 1); ++k) {
      for (int j = 0; j <= quartic; ++j) {
        const Four* place = grid + s.first + (static_cast<std::int64_t>(k) * n[1] + j) * n[0];
        Four value{}, slope{};
        for (int i = 0; i <= quartic; ++i) {
          value += s.value[0][i] * place[i];
          slope += g.value[0][i] * place[i];
        }
        sum += s.value[2][k] * s.value[1][j] * value;
        by[0] += s.value[2][k] * s.value[1][j] * slope;
        by[1] += s.value[2][k] * g.value[1][j] * value;
        by[2] += g.value[2][k] * s.value[1][j] * value;
      }
    }
    Vec3* of_node = z + a * (1 + d);
    algebra::store_three(of_node[0].data(), algebra::load_three(of_node[0]) + sum);
    for (int i = 0; i < d; ++i)
      algebra::store_three(of_node[1 + i].data(), algebra::load_three(of_node[1 + i]) + by[i]);
  }
}

}  // namespace diptych::closure
