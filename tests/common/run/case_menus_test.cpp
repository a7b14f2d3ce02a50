/// The keys of case files whose menus are in rooms above the reader.

#include "common/cases/keys.hpp"
#include "common/run/model_menu.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/kernels/kernel.hpp"
#include "sph/sph_graph.hpp"

#include <gmock/gmock.h>
#include <set>

namespace diptych::cases {
namespace {

/// What the program gives to the reader.
const Menus& menus_above() {
  static const Menus menus{{"material.model", run::model_menu().names()},
                           {"sph.kernel", sph::kernels().names()},
                           {"sph.gradient", sph::gradient_names()},
                           {"fvm.stencil", fvm::stencil_names()}};
  return menus;
}

TEST(CaseKeys, HaveTheirMenuHereOrAbove) {
  for (const auto& [path, names] : menus_above()) {
    const Key* key = find_key(path);
    ASSERT_NE(key, nullptr) << path;
    EXPECT_EQ(key->type, KeyType::name) << path;
    EXPECT_TRUE(key->menu.empty()) << path << " has two menus";
    const std::string standard = key->standard.substr(1, key->standard.size() - 2);
    EXPECT_THAT(names, testing::Contains(standard)) << path;
  }
}

TEST(CaseKeys, AreUniqueAndComplete) {
  std::set<std::string_view> paths;
  for (const Key& key : keys()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path;
    EXPECT_FALSE(key.meaning.empty() || key.example.empty() || key.unit.empty()) << key.path;
    EXPECT_TRUE(!key.standard.empty() || !key.need.empty()) << key.path << ": default or need";
    EXPECT_EQ(key.type == KeyType::name, !names_of(key, menus_above()).empty()) << key.path;
    const size_t dot = key.path.rfind('.');
    const bool has_section =
        dot == std::string_view::npos || find_section(key.path.substr(0, dot)) != nullptr;
    EXPECT_TRUE(has_section) << key.path;
  }
}

}  // namespace
}  // namespace diptych::cases
