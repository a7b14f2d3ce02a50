#pragma once
/// Watches how far nodes slide along curved sides that hold their normal velocity (type
/// "symmetry"): each stays in the tangent plane where it began, so a node that slides by s on a
/// radius R leaves the surface by s^2/2R, and the body swings about its place like a pendulum
/// instead of sliding on. Test: tests/harness/sliding_watch_test.cpp

#include "common/cases/case.hpp"
#include "common/run/observers/observer.hpp"
#include "meshes/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

class SlidingWatch : public run::Observer {
 public:
  SlidingWatch(const cases::Case& setup, const meshes::Mesh& mesh);

  /// Looks at no more than 2000 evenly chosen nodes of each condition.
  void at_output(const run::Output& output) override;
  void at_breakdown(const run::Output& output) override { at_output(output); }
  void archive(algebra::Archive& archive) override;

  /// What is to be told: nothing unless a node slid to where the normal of the side is another by
  /// more than 0.01.
  std::optional<std::string> notice() const;

 private:
  struct Side {
    std::string groups;
    std::vector<std::int32_t> nodes;
    std::vector<algebra::Mat3>
        turning;        ///< [nodes] 1/m, of the normal with the place along the side
    double turned = 0;  ///< rad, most so far
    double slid = 0;    ///< m, with it
    double time = 0;    ///< s, of it
  };
  std::vector<Side> sides_;
};

}  // namespace diptych::harness
