/// The table of fields of a body: what is done to all fields goes by it.

#include "common/scheme/body/body.hpp"

#include "common/run/state_hash.hpp"
#include "tests/common/scheme/scenes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace diptych::scheme {
namespace {

BodyOptions viscoelastic(Unknowns unknowns) {
  BodyOptions options;
  options.rho_R = 1000;
  options.n_branches = 2;
  options.has_G = true;
  options.unknowns = unknowns;
  return options;
}

PairGraph lattice(meshes::CellType type) {
  const bool plane = type == meshes::CellType::quadrilateral;
  return tests::graph_of("fvm", meshes::box(type, {0, 0, 0}, {1, 1, plane ? 0.0 : 1.0}, {4, 3, 2}));
}

/// Numbers of the unknowns of a node in three dimensions: v, u, F, and H, J, A, S where they are.
TEST(Body, CountsItsUnknownsByItsTable) {
  const PairGraph graph = lattice(meshes::CellType::hexahedron);
  const int branches = 2 * (6 + 6);
  EXPECT_EQ(Body<3>(graph, viscoelastic(Unknowns::F)).unknowns_per_node(), 15 + branches);
  EXPECT_EQ(Body<3>(graph, viscoelastic(Unknowns::FJ)).unknowns_per_node(), 16 + branches);
  EXPECT_EQ(Body<3>(graph, viscoelastic(Unknowns::FHJ)).unknowns_per_node(), 25 + branches);
  // in plane strain H has five components, in two places of one name; A and S four each
  const Body<2> plane(lattice(meshes::CellType::quadrilateral), viscoelastic(Unknowns::FHJ));
  EXPECT_EQ(plane.unknowns_per_node(), 2 + 2 + 4 + 5 + 1 + 2 * (3 + 4));
}

TEST(Body, HasUnitsAndPlacesForAllItsFieldsAndAllocatesThem) {
  BodyOptions options = viscoelastic(Unknowns::FHJ);
  options.exact_impedance = options.face_correction = options.keeps_L_0 = true;
  const Body<3> body(lattice(meshes::CellType::hexahedron), options);
  std::set<std::pair<Role, std::string>> names;
  for (const Field<3>& field : body.fields()) {
    EXPECT_FALSE(field.unit.empty()) << field.name;
    EXPECT_NE(field.table == nullptr, field.block == nullptr) << field.name;
    EXPECT_GT(field.n_components, 0) << field.name;
    EXPECT_TRUE(names.insert({field.role, std::string(field.name)}).second) << field.name;
    for (int c = 0; c < field.n_components; ++c)
      EXPECT_EQ(field.at(body, body.n_owned - 1, c), 0) << field.name << " at rest";
  }
  EXPECT_EQ(body.n_owned, body.n_stored);
  EXPECT_GT(body.bytes(), 0);
  EXPECT_GT(body.bytes(), Body<3>(lattice(meshes::CellType::hexahedron), {}).bytes());
}

/// Every unknown component of every node counts; what follows from them does not.
TEST(Body, HashesEveryUnknownAndNothingElse) {
  const PairGraph graph = lattice(meshes::CellType::quadrilateral);
  const auto order = tests::natural_order(graph);
  Body<2> body(graph, viscoelastic(Unknowns::FHJ));
  const std::string at_rest = run::state_hash(body, order, 0);
  EXPECT_NE(run::state_hash(body, order, 1), at_rest);
  const std::int64_t last = body.n_owned - 1;
  for (const Field<2>& field : body.fields()) {
    for (int c = 0; c < field.n_components; ++c) {
      const auto set = [&](double value) {
        if (field.table != nullptr) {
          (body.*field.table).set(last, field.first + c, value);
        } else {
          (body.*field.block).set(last, field.first + c, value);
        }
      };
      set(0.5);
      EXPECT_EQ(run::state_hash(body, order, 0) != at_rest, field.role == Role::unknown)
          << field.name << " " << c;
      set(0);
    }
  }
  EXPECT_EQ(run::state_hash(body, order, 0), at_rest);
}

}  // namespace
}  // namespace diptych::scheme
