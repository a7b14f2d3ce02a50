#pragma once
/// The surface that the boundary faces of a mesh stand for: kinks between its smooth sides, and
/// faces of second order through the nodes of each of them.
///
/// The middle of an edge within a smooth side lies on the cubic through its ends whose tangents are
/// at right angles to the side's normals there, which come from the quadratic through the nodes
/// around; that of an edge along a kink on the cubic whose tangents come from its neighbours along
/// the kink. So neighbouring faces have their common edge in common. Edges of plane sides are
/// straight.
/// Source: notes 4.5; Vlachos, Peters, Boyd & Mitchell, Curved PN triangles, 2001, for the middles.
/// Test: tests/meshes/surface_test.cpp

#include "common/algebra/vectors.hpp"
#include "meshes/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych::meshes {

/// A point of a rule on a face, or between it and its facet.
struct SurfacePoint {
  std::array<double, 4> N{};  ///< shape functions of the facet
  Vec3 X = Vec3::Zero();      ///< m
  Vec3 area = Vec3::Zero();   ///< N dA of the rule, outward, m^2 (m in 2-D)
  Vec3 bulge = Vec3::Zero();  ///< of the face over its facet, m
};

/// Places and weights of Gauss's rule of three points between 0 and 1.
inline constexpr std::array<std::array<double, 2>, 3> unit_line{
    {{0.5 - 0.3872983346207417, 5. / 18}, {0.5, 8. / 18}, {0.5 + 0.3872983346207417, 5. / 18}}};

/// Smooth sides of boundary faces: for each a number that those of its side have in common.
/// @pre as of Surface, of which only nodes, boundary faces and the dimension are read
std::vector<std::int32_t> smooth_sides(const Mesh& mesh);

class Surface {
 public:
  /// @pre mesh.boundary_faces are filled and outward, and the mesh outlives the surface
  explicit Surface(const Mesh& mesh);

  /// Whether a face is not its facet.
  bool is_curved(std::int32_t f) const { return is_curved_[f] != 0; }
  bool has_curved_faces() const;
  /// Whether the side of a face is plane; a face of it may have a curved rim.
  bool is_of_plane(std::int32_t f) const { return is_plane_[f] != 0; }

  /// Area vector of the facet, outward, m^2 (m in 2-D).
  const Vec3& facet_area(std::int32_t f) const { return area_[f]; }

  /// Calls visit(f, g) for faces that go on into one another without a kink, or in one plane.
  template <class Visit>
  void for_joints(bool in_one_plane, const Visit& visit) const {
    for (const Joint& joint : joints_) {
      if (in_one_plane ? joint.is_plane : !joint.is_kink) visit(joint.face[0], joint.face[1]);
    }
  }

  /// Points of a Gauss rule on face f (height = 1), on its facet (0) or between the two.
  std::vector<SurfacePoint> points(std::int32_t f, double height) const;

 private:
  friend std::vector<std::int32_t> smooth_sides(const Mesh& mesh);
  enum class Bent { no, yes };
  Surface(const Mesh& mesh, Bent bent);

  /// Where faces meet: an edge, in the plane a node (nodes[1] = -1).
  struct Joint {
    std::array<std::int32_t, 2> nodes{-1, -1};
    std::array<std::int32_t, 2> face{-1, -1};
    std::array<std::int8_t, 2> edge{};  ///< its number in each face
    int n_faces = 0;
    bool is_kink = false;
    bool is_plane = false;
  };

  void find_joints();
  void find_kinks();
  double turn(std::int32_t f, std::int32_t g) const;
  double largest_turn(std::int32_t f, const Joint& without) const;
  void join_sides();
  void bend_in_the_plane();
  void bend_kinks();
  void bend_sides();
  Vec3 normal_at(std::int32_t a, std::int32_t side) const;
  void set_bulge(const Joint& joint, const Vec3& bulge);
  std::span<const std::int32_t> corners(std::int32_t f) const {
    const BoundaryFace& face = mesh_.boundary_faces[f];
    return {face.nodes.data(), static_cast<size_t>(face.n_nodes)};
  }

  const Mesh& mesh_;
  std::vector<Vec3> area_, normal_;                ///< of the facets, normals of length one
  std::vector<std::vector<std::int32_t>> around_;  ///< faces of a node
  std::vector<Joint> joints_;
  std::vector<std::int32_t> side_;          ///< smooth side of a face: one of its faces
  std::vector<std::uint8_t> is_plane_;      ///< of a face: its side is plane
  std::vector<std::array<Vec3, 4>> bulge_;  ///< of the middles of a face's edges
  std::vector<std::uint8_t> is_curved_;
};

}  // namespace diptych::meshes
