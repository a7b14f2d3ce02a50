#include "common/scheme/boundary/resolved_load.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace diptych::scheme {

namespace {

/// A face is resolved where int |f - sum f_b phi_b| is a smaller share of the largest int |f| over
/// a face: waves of eight faces and more.
constexpr double unresolved = 0.05;
/// Points of a Fibonacci lattice with its mirror image: as many different places along both
/// directions, so that a jump across one is met to 1/(2 n) of the face.
constexpr int n_points = 89, fibonacci = 55;

using Reference = std::array<double, 2>;  ///< of [0, 1]^2

std::vector<Reference> reference_points(int dimension) {
  std::vector<Reference> points;
  for (int k = 0; k < 2 * n_points; ++k) {
    const double x = (k % n_points + 0.5) / n_points, y = fibonacci * x - std::floor(fibonacci * x);
    if (dimension == 1) {
      points.push_back({(k + 0.5) / (2 * n_points), 0});
    } else {
      points.push_back({x, k < n_points ? y : 1 - y});
    }
  }
  return points;
}

/// Shape functions of the corners and their derivatives along the directions of the reference.
struct Shape {
  std::array<double, 4> phi{};
  std::array<std::array<double, 4>, 2> slope{};
};

/// An edge or a triangle: the coordinates in falling order cut the unit interval into its shares.
Shape simplex(const Reference& at, int dimension) {
  Reference x = at;
  if (dimension == 2 && x[0] < x[1]) std::swap(x[0], x[1]);
  Shape shape;
  for (int i = 0; i <= dimension; ++i) {
    shape.phi[i] = (i == 0 ? 1 : x[i - 1]) - (i == dimension ? 0 : x[i]);
    if (i > 0) shape.slope[i - 1][i] = 1;
    if (i < dimension) shape.slope[i][i] = -1;
  }
  return shape;
}

Shape quadrilateral(const Reference& at) {
  const auto [x, y] = at;
  return {{(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y},
          {{{y - 1, 1 - y, y, -y}, {x - 1, -x, x, 1 - x}}}};
}

/// Shape functions at the points of a face.
struct Points {
  std::vector<Shape> shapes;
  double weight = 0;  ///< of one of them, in the reference
};

Points points_of(int n_corners) {
  Points points;
  for (const Reference& x : reference_points(n_corners == 2 ? 1 : 2))
    points.shapes.push_back(n_corners == 4 ? quadrilateral(x) : simplex(x, n_corners - 1));
  // ordered coordinates are those of half the square
  points.weight = (n_corners == 3 ? 0.5 : 1) / static_cast<double>(points.shapes.size());
  return points;
}

double size_of(double value) {
  return std::abs(value);
}
double size_of(const Vec3& value) {
  return value.norm();
}
template <class Value>
Value zero() {
  if constexpr (std::is_same_v<Value, double>) {
    return 0;
  } else {
    return Value::Zero();
  }
}

/// Faces with points in them.
template <class Value>
class Integrals {
 public:
  /// @param areas  [nodes] m^2, to which int phi_a dA of the faces is added
  Integrals(const FieldFunction<Value>& load,
            std::span<const Vec3> X,
            std::vector<PatchFace> faces,
            std::vector<double>& areas)
      : faces_(std::move(faces)) {
    std::vector<Vec3> places;
    for (const PatchFace& face : faces_) {
      if (points_.count(face.n_corners) == 0)
        points_.emplace(face.n_corners, points_of(face.n_corners));
      const Points& points = points_.at(face.n_corners);
      for (const Shape& shape : points.shapes) {
        Vec3 place = Vec3::Zero();
        std::array<Vec3, 2> along{Vec3::Zero(), Vec3::Zero()};
        for (int k = 0; k < face.n_corners; ++k) {
          const Vec3& corner = X[static_cast<size_t>(face.corner[k])];
          place += shape.phi[k] * corner;
          for (size_t d = 0; d < 2; ++d)
            along[d] += shape.slope[d][k] * corner;
        }
        const Vec3 N = points.weight * (face.n_corners == 2 ? Vec3(along[0][1], -along[0][0], 0)
                                                            : Vec3(along[0].cross(along[1])));
        places.push_back(place);
        weights_.push_back(N.norm());
        for (int k = 0; k < face.n_corners; ++k)
          areas[static_cast<size_t>(face.corner[k])] += shape.phi[k] * N.norm();
      }
    }
    placed_ = load.placed(places);
  }

  /// @param nodes  values there at the same time
  /// @param visit  of each face, with its place among them, int (f - f_h) phi_k of its corners,
  ///               int |f - f_h| and int |f|
  template <class Visit>
  void at(double t, const std::vector<Value>& nodes, const Visit& visit) const {
    const std::vector<Value> values = placed_->at(t);
    size_t point = 0;
    for (size_t p = 0; p < faces_.size(); ++p) {
      const PatchFace& face = faces_[p];
      std::array<Value, 4> missed;
      missed.fill(zero<Value>());
      double all = 0, rest = 0;
      for (const Shape& shape : points_.at(face.n_corners).shapes) {
        Value difference = values[point];
        all += weights_[point] * size_of(difference);
        for (int k = 0; k < face.n_corners; ++k)
          difference -= shape.phi[k] * nodes[static_cast<size_t>(face.corner[k])];
        rest += weights_[point] * size_of(difference);
        for (int k = 0; k < face.n_corners; ++k)
          missed[k] += weights_[point] * shape.phi[k] * difference;
        ++point;
      }
      visit(p, missed, rest, all);
    }
  }

  const PatchFace& face(size_t p) const { return faces_[p]; }

 private:
  std::vector<PatchFace> faces_;
  std::map<int, Points> points_;  ///< by the number of corners
  std::vector<double> weights_;   ///< [points of all faces] m^2
  std::unique_ptr<PlacedField<Value>> placed_;
};

/// How nodes see a load on the faces of a patch.
struct Survey {
  /// The faces that nodes do not resolve; all of them where these are others at other times.
  std::vector<PatchFace> unresolved_faces;
  std::vector<double> areas;  ///< [nodes] int phi_a dA over all faces  [m^2]
};

/// Whether a load acts at nodes, but not at all corners of any face. Else, where no place within
/// faces sees it, it is said of a curved side, and faces are only flat.
template <class Value>
bool is_of_nodes_alone(const std::vector<Value>& nodes, std::span<const PatchFace> faces) {
  const auto acts_at = [&](std::int32_t a) { return size_of(nodes[static_cast<size_t>(a)]) > 0; };
  return std::any_of(nodes.begin(), nodes.end(), [](const Value& v) { return size_of(v) > 0; }) &&
         std::none_of(faces.begin(), faces.end(), [&](const PatchFace& face) {
           const auto corners = std::span(face.corner).first(static_cast<size_t>(face.n_corners));
           return std::all_of(corners.begin(), corners.end(), acts_at);
         });
}

template <class Value>
size_t first_loaded(const std::vector<Value>& nodes) {
  const auto at = std::find_if(nodes.begin(), nodes.end(),
                               [](const Value& value) { return size_of(value) > 0; });
  return static_cast<size_t>(at - nodes.begin());
}

template <class Value>
Survey survey(const FieldFunction<Value>& load,
              std::span<const Vec3> X,
              std::span<const PatchFace> faces,
              const PlacedField<Value>& at_nodes,
              SeenLoad& seen) {
  constexpr size_t at_a_time = 256;  // their points take room
  const std::span<const double> instants = load.in_place().instants;
  Survey found;
  if (instants.empty()) return found;
  found.areas.assign(X.size(), 0);
  std::vector<std::vector<Value>> nodes;
  for (const double t : instants)
    nodes.push_back(at_nodes.at(t));
  std::vector<std::vector<double>> rest(instants.size(), std::vector<double>(faces.size()));
  std::vector<double> largest(instants.size(), 0), missed_most = largest;
  for (size_t first = 0; first < faces.size(); first += at_a_time) {
    const auto some = faces.subspan(first, std::min(at_a_time, faces.size() - first));
    const Integrals<Value> integrals(load, X, {some.begin(), some.end()}, found.areas);
    for (size_t i = 0; i < instants.size(); ++i) {
      integrals.at(instants[i], nodes[i], [&](size_t p, const auto&, double missed, double all) {
        rest[i][first + p] = missed;
        largest[i] = std::max(largest[i], all);
        missed_most[i] = std::max(missed_most[i], missed);
      });
    }
  }
  std::vector<char> wanted;
  size_t n_seen = 0;
  for (size_t i = 0; i < instants.size(); ++i) {
    seen.within_faces |= largest[i] > 0;
    if (largest[i] == 0) {
      if (!is_of_nodes_alone(nodes[i], faces)) continue;
      largest[i] = missed_most[i];
      if (!load.in_place().travels) seen.on_nodes_alone = X[first_loaded(nodes[i])];
    }
    ++n_seen;
    std::vector<char> now(faces.size());
    for (size_t p = 0; p < faces.size(); ++p)
      now[p] = rest[i][p] > unresolved * largest[i] ? 1 : 0;
    if (wanted.empty()) wanted = now;
    if (now == wanted) continue;
    wanted.assign(faces.size(), 1);
    break;
  }
  // a pulse that acts at none of them may be anything
  if (n_seen == 0 && instants.size() > 1) wanted.assign(faces.size(), 1);
  // what travels was not looked at on its way: resolved is only what was seen so often
  const bool is_resolved = std::count(wanted.begin(), wanted.end(), 1) == 0;
  if (load.in_place().travels && !(is_resolved && 2 * n_seen > instants.size()))
    wanted.assign(faces.size(), 1);
  for (size_t p = 0; p < wanted.size(); ++p) {
    if (wanted[p] != 0) found.unresolved_faces.push_back(faces[p]);
  }
  return found;
}

template <class Value>
class ResolvedLoad : public PlacedField<Value> {
 public:
  /// @param areas  of the shape functions
  ResolvedLoad(std::unique_ptr<PlacedField<Value>> at_nodes,
               Integrals<Value> missed,
               std::span<const double> area,
               const std::vector<double>& areas)
      : at_nodes_(std::move(at_nodes)), missed_(std::move(missed)) {
    if (area.empty()) return;
    const double rounding = 1e-6 * *std::max_element(area.begin(), area.end());
    for (size_t a = 0; a < areas.size(); ++a) {
      excess_.push_back(area[a] - areas[a]);
      per_area_.push_back(area[a] > rounding ? 1 / area[a] : 0);
    }
  }

  /// Areas of higher order than those of shape functions, which count for what is smooth alone,
  /// would load a strip along an edge with too much or too little: what they make of the whole
  /// force is taken from the faces on which nodes miss something, in proportion, and not more than
  /// that.
  std::vector<Value> at(double t) const override {
    const std::vector<Value> nodes = at_nodes_->at(t);
    Value excess = zero<Value>();
    for (size_t a = 0; a < nodes.size(); ++a)
      excess += excess_[a] * nodes[a];
    double all_missed = 0;
    std::vector<Value> forces(nodes.size(), zero<Value>());
    std::vector<double> missed_at(nodes.size(), 0);
    missed_.at(t, nodes, [&](size_t p, const auto& missed, double size, double) {
      const PatchFace& face = missed_.face(p);
      all_missed += size;
      for (int k = 0; k < face.n_corners; ++k) {
        const auto a = static_cast<size_t>(face.corner[k]);
        forces[a] += missed[k];
        missed_at[a] += size / face.n_corners;
      }
    });
    const double largest = std::max(all_missed, size_of(excess));
    std::vector<Value> values = nodes;
    for (size_t a = 0; a < nodes.size() && largest > 0; ++a)
      values[a] += per_area_[a] * (forces[a] - missed_at[a] / largest * excess);
    return values;
  }

 private:
  std::unique_ptr<PlacedField<Value>> at_nodes_;
  Integrals<Value> missed_;
  std::vector<double> per_area_, excess_;  ///< [nodes] 1/m^2; m^2, beyond areas of shape functions
};

}  // namespace

template <class Value>
std::unique_ptr<PlacedField<Value>> resolved_load(const FieldFunction<Value>& load,
                                                  std::span<const Vec3> X,
                                                  std::span<const double> area,
                                                  std::span<const PatchFace> faces,
                                                  SeenLoad& seen) {
  std::unique_ptr<PlacedField<Value>> at_nodes = load.placed(X);
  const Survey found = survey(load, X, faces, *at_nodes, seen);
  if (found.unresolved_faces.empty()) return at_nodes;
  std::vector<double> of_them(X.size(), 0);
  Integrals<Value> missed(load, X, found.unresolved_faces, of_them);
  return std::make_unique<ResolvedLoad<Value>>(std::move(at_nodes), std::move(missed), area,
                                               found.areas);
}

std::string no_area_for(const Vec3& node) {
  return fmt::format(
      "a load acts at the node at ({:.6g}, {:.6g}, {:.6g}) m, but at none of {} places in each "
      "face "
      "around it: it has hardly an area; give it one that is a hundredth of a face or more",
      node.x(), node.y(), node.z(), 2 * n_points);
}

template std::unique_ptr<PlacedField<Vec3>> resolved_load(const FieldFunction<Vec3>&,
                                                          std::span<const Vec3>,
                                                          std::span<const double>,
                                                          std::span<const PatchFace>,
                                                          SeenLoad&);
template std::unique_ptr<PlacedField<double>> resolved_load(const FieldFunction<double>&,
                                                            std::span<const Vec3>,
                                                            std::span<const double>,
                                                            std::span<const PatchFace>,
                                                            SeenLoad&);

}  // namespace diptych::scheme
