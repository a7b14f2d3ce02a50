#include "meshes/shape_integrals.hpp"

#include "common/algebra/face_areas.hpp"

#include <cassert>
#include <cmath>

namespace diptych::meshes {

namespace {

const double gauss = 1 / std::sqrt(3.0);

/// Values of a one-dimensional or triangular factor of a shape function and its derivatives.
struct Line {
  double value, slope;
};

/// Linear function on [-1,1] that is 1 at `end` (-1 or +1).
Line line(double end, double x) {
  return {(1 + end * x) / 2, end / 2};
}

/// Barycentric coordinate i of the unit triangle, and its (constant) gradient.
double barycentric(int i, const Vec3& xi) {
  return i == 0 ? 1 - xi[0] - xi[1] : xi[i - 1];
}
Vec3 barycentric_gradient(int i) {
  return i == 0 ? Vec3(-1, -1, 0) : Vec3(i == 1 ? 1 : 0, i == 2 ? 1 : 0, 0);
}

/// Fills N and dN of `point` at the reference coordinate xi.
void evaluate(CellType type, const ReferenceCell& cell, const Vec3& xi, QuadraturePoint& point) {
  for (int a = 0; a < cell.n_nodes; ++a) {
    const Vec3& X = cell.nodes[a];
    if (type == CellType::triangle) {
      point.N[a] = barycentric(a, xi);
      point.dN[a] = barycentric_gradient(a);
    } else if (type == CellType::tetrahedron) {
      point.N[a] = a == 0 ? 1 - xi.sum() : xi[a - 1];
      point.dN[a] = a == 0 ? Vec3(-1, -1, -1) : Vec3(Vec3::Unit(a - 1));
    } else if (type == CellType::prism) {
      const Line z = line(X[2], xi[2]);
      const double t = barycentric(a % 3, xi);
      const Vec3 dt = barycentric_gradient(a % 3);
      point.N[a] = t * z.value;
      point.dN[a] = Vec3(dt[0] * z.value, dt[1] * z.value, t * z.slope);
    } else {
      const Line x = line(X[0], xi[0]), y = line(X[1], xi[1]);
      const Line z = type == CellType::hexahedron ? line(X[2], xi[2]) : Line{1, 0};
      point.N[a] = x.value * y.value * z.value;
      point.dN[a] = Vec3(x.slope * y.value * z.value, x.value * y.slope * z.value,
                         x.value * y.value * z.slope);
    }
  }
}

struct Place {
  Vec3 xi;
  double weight;
};

/// Points of the exact rules: centroid (simplices: N_a grad N_b is linear), Gauss 2^d, and
/// degree 2 triangle x Gauss 2 on prisms.
std::vector<Place> exact_places(CellType type) {
  std::vector<Place> places;
  const double ends[2] = {-gauss, gauss};
  switch (type) {
    case CellType::triangle:
      return {{Vec3(1. / 3, 1. / 3, 0), 0.5}};
    case CellType::tetrahedron:
      return {{Vec3(0.25, 0.25, 0.25), 1. / 6}};
    case CellType::quadrilateral:
      for (double y : ends) {
        for (double x : ends)
          places.push_back({Vec3(x, y, 0), 1});
      }
      return places;
    case CellType::hexahedron:
      for (double z : ends) {
        for (double y : ends) {
          for (double x : ends)
            places.push_back({Vec3(x, y, z), 1});
        }
      }
      return places;
    case CellType::prism:
      for (double z : ends) {
        for (int i = 0; i < 3; ++i) {
          places.push_back({Vec3(i == 1 ? 2. / 3 : 1. / 6, i == 2 ? 2. / 3 : 1. / 6, z), 1. / 6});
        }
      }
      return places;
  }
  return places;
}

/// Of simplices, and of the triangle of a prism, Gauss points of squares and cubes that are
/// collapsed onto them.
std::vector<Place> fine_places(CellType type) {
  const double g = std::sqrt(0.6);
  const Place line[3] = {
      {Vec3(-g, 0, 0), 5. / 9}, {Vec3(0, 0, 0), 8. / 9}, {Vec3(g, 0, 0), 5. / 9}};
  const bool is_flat = dimension_of(type) == 2;
  std::vector<Place> places;
  for (int k = 0; k < (is_flat ? 1 : 3); ++k) {
    for (const Place& y : line) {
      for (const Place& x : line) {
        Vec3 xi(x.xi[0], y.xi[0], is_flat ? 0 : line[k].xi[0]);
        double weight = x.weight * y.weight * (is_flat ? 1 : line[k].weight);
        if (type == CellType::triangle || type == CellType::prism ||
            type == CellType::tetrahedron) {
          const double s = (1 + xi[0]) / 2, t = (1 + xi[1]) / 2 * (1 - s);
          weight *= (1 - s) / 4;
          const double u = (1 + xi[2]) / 2 * (1 - s - t);
          if (type == CellType::tetrahedron) weight *= (1 - s - t) / 2;
          xi = Vec3(s, t, type == CellType::tetrahedron ? u : xi[2]);
        }
        places.push_back({xi, weight});
      }
    }
  }
  return places;
}

/// Reference coordinates and, per node, the nodes at the other ends of its edges.
void place_nodes(CellType type, ReferenceCell& cell) {
  switch (type) {
    case CellType::triangle:
      cell.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
      cell.edges = {{{1, 2}, {2, 0}, {0, 1}}};
      break;
    case CellType::quadrilateral:
      cell.nodes = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};
      cell.edges = {{{1, 3}, {2, 0}, {3, 1}, {0, 2}}};
      break;
    case CellType::tetrahedron:
      cell.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
      cell.edges = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
      break;
    case CellType::hexahedron:
      cell.nodes = {Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(-1, 1, -1),
                    Vec3(-1, -1, 1),  Vec3(1, -1, 1),  Vec3(1, 1, 1),  Vec3(-1, 1, 1)};
      cell.edges = {
          {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
      break;
    case CellType::prism:
      cell.nodes = {Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(0, 1, -1),
                    Vec3(0, 0, 1),  Vec3(1, 0, 1),  Vec3(0, 1, 1)};
      cell.edges = {{{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}}};
      break;
  }
}

ReferenceCell make_reference_cell(CellType type) {
  ReferenceCell cell;
  static constexpr int n_nodes[] = {3, 4, 4, 8, 6};
  static constexpr double measure[] = {0.5, 4, 1. / 6, 8, 1};
  cell.n_nodes = n_nodes[static_cast<int>(type)];
  cell.dimension = type == CellType::triangle || type == CellType::quadrilateral ? 2 : 3;
  place_nodes(type, cell);
  for (int a = 0; a < cell.n_nodes; ++a) {
    QuadraturePoint& point = cell.vertex.emplace_back();
    point.weight = measure[static_cast<int>(type)] / cell.n_nodes;
    evaluate(type, cell, cell.nodes[a], point);
  }
  for (const Place& place : exact_places(type)) {
    QuadraturePoint& point = cell.exact.emplace_back();
    point.weight = place.weight;
    evaluate(type, cell, place.xi, point);
  }
  for (const Place& place : fine_places(type)) {
    QuadraturePoint& point = cell.fine.emplace_back();
    point.weight = place.weight;
    evaluate(type, cell, place.xi, point);
  }
  return cell;
}

}  // namespace

const ReferenceCell& reference_cell(CellType type) {
  static const std::array<ReferenceCell, 5> cells = {
      make_reference_cell(CellType::triangle), make_reference_cell(CellType::quadrilateral),
      make_reference_cell(CellType::tetrahedron), make_reference_cell(CellType::hexahedron),
      make_reference_cell(CellType::prism)};
  return cells[static_cast<size_t>(type)];
}

Mat3 jacobian(const ReferenceCell& cell,
              const QuadraturePoint& point,
              std::span<const std::int32_t> nodes,
              const std::vector<Vec3>& X) {
  // from the first node: a body far from the origin loses no digits
  Mat3 J = Mat3::Zero();
  for (int a = 1; a < cell.n_nodes; ++a) {
    if (point.dN[a].isZero(0)) continue;  // at a node: all but its edges
    const Vec3 from_first = X[nodes[a]] - X[nodes[0]];
    for (int j = 0; j < 3; ++j)  // an outer product would be stored and loaded in different pieces
      J.col(j) += from_first * point.dN[a][j];
  }
  if (cell.dimension == 2) J(2, 2) = 1;
  return J;
}

Mat3 cofactor(const Mat3& J) {
  Mat3 cof;
  cof.col(0) = J.col(1).cross(J.col(2));
  cof.col(1) = J.col(2).cross(J.col(0));
  cof.col(2) = J.col(0).cross(J.col(1));
  return cof;
}

std::array<Vec3, 4> face_area_shares(const BoundaryFace& face,
                                     const std::vector<Vec3>& X,
                                     Quadrature quadrature) {
  assert(face.n_nodes >= 2 && face.n_nodes <= 4);
  std::array<Vec3, 4> corner;
  for (int i = 0; i < face.n_nodes; ++i)
    corner[i] = X[face.nodes[i]];
  if (face.n_nodes < 4 || quadrature == Quadrature::exact) {
    return algebra::face_area_shares(corner, face.n_nodes);
  }
  std::array<Vec3, 4> share;
  for (int a = 0; a < 4; ++a) {
    share[a] = 0.25 * (corner[(a + 1) % 4] - corner[a]).cross(corner[(a + 3) % 4] - corner[a]);
  }
  return share;
}

Vec3 face_area(const BoundaryFace& face, const std::vector<Vec3>& X) {
  Vec3 area = Vec3::Zero();
  for (const Vec3& share : face_area_shares(face, X, Quadrature::exact))
    area += share;
  return area;
}

}  // namespace diptych::meshes
