#pragma once
/// Watches for parts of a body that pass through a rigid wall because they are in none of the
/// groups that may touch it. Test: tests/harness/wall_watch_test.cpp

#include "common/cases/case.hpp"
#include "common/run/observers/observer.hpp"
#include "meshes/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

class WallWatch : public run::Observer {
 public:
  /// @param spacing  of the nodes  [m]
  WallWatch(const cases::Case& setup, const meshes::Mesh& mesh, double spacing);

  /// Looks at boundary nodes that no wall knows, at most at 2000 evenly chosen ones per wall.
  void at_output(const run::Output& output) override;
  void at_breakdown(const run::Output& output) override { at_output(output); }
  void archive(algebra::Archive& archive) override;

  /// What is to be told: nothing unless a node that was in front of a wall came behind it by more
  /// than a quarter of the spacing.
  std::optional<std::string> notice() const;

 private:
  struct Wall {
    algebra::Vec3 point, normal;      ///< normal of unit length
    std::string groups;               ///< that may touch it
    std::vector<std::int32_t> nodes;  ///< that were in front of it and may not
    std::vector<algebra::Vec3> X;     ///< [nodes] m
    double depth = 0;                 ///< m, greatest so far
    std::int64_t node = 0;            ///< with it, an entry of nodes
    double time = 0;                  ///< s, of it
  };

  double spacing_;
  std::vector<Wall> walls_;
};

}  // namespace diptych::harness
