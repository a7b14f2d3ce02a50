/// Random damage to good files, the same in every run: the reader must refuse it or give a mesh
/// that holds all promises of meshes/gmsh.hpp. Anything else (another exception, a crash, a huge
/// allocation) fails; the sanitizer build sees reads past the end.

#include "meshes/gmsh.hpp"
#include "meshes/msh/contents.hpp"
#include "tests/meshes/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace diptych::meshes {
namespace {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  /// Uniform enough in [0, n).
  size_t below(size_t n) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return (x ^ (x >> 31)) % n;
  }

 private:
  std::uint64_t state_;
};

const std::vector<std::string> nasty_words{"-1",
                                           "0",
                                           "7",
                                           "9",
                                           "11",
                                           "15",
                                           "99999999999999999999",
                                           "9223372036854775807",
                                           "-2147483648",
                                           "2147483647",
                                           "nan",
                                           "inf",
                                           "1e308",
                                           "1e-320",
                                           "$EndNodes",
                                           "$Elements",
                                           "\"",
                                           ""};

/// Puts a nasty word in the place of a random one.
void damage_word(std::string& bytes, Chance& chance) {
  const size_t start = bytes.find_first_not_of(" \n", chance.below(bytes.size()));
  if (start == std::string::npos) return;
  const size_t end = std::min(bytes.find_first_of(" \n", start), bytes.size());
  bytes.replace(start, end - start, nasty_words[chance.below(nasty_words.size())]);
}

/// Writes an extreme number over a random place.
void damage_number(std::string& bytes, Chance& chance) {
  const std::int64_t numbers[] = {-1, 0, 1, 2, 7, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN};
  const std::int64_t number = numbers[chance.below(std::size(numbers))];
  const size_t size = chance.below(2) == 0 ? 4 : 8;
  std::memcpy(bytes.data() + chance.below(bytes.size() - 8), &number, size);
}

void damage(std::string& bytes, Chance& chance) {
  const size_t at = chance.below(bytes.size());
  switch (chance.below(6)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << chance.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(chance.below(256));
      break;
    case 2:
      bytes.erase(at, 1 + chance.below(20));
      break;
    case 3:
      bytes.insert(at, bytes.substr(chance.below(bytes.size()), chance.below(60)));
      break;
    case 4:
      damage_word(bytes, chance);
      break;
    default:
      damage_number(bytes, chance);
      break;
  }
}

void expect_sound(const Mesh& mesh) {
  check_cells(mesh, "mutated");
  // Coordinates may have become large: compared with the sum of the areas, not with one.
  double sum = 0;
  for (const auto& face : mesh.boundary_faces)
    sum += area_vector(mesh, face).norm();
  EXPECT_LE(area_of_boundary(mesh).norm(), 1e-12 * sum);
  for (const auto& group : mesh.boundary_groups) {
    EXPECT_FALSE(group.name.empty());
    EXPECT_FALSE(group.faces.empty());
    for (const std::int32_t face : group.faces) {
      EXPECT_LT(static_cast<size_t>(face), mesh.boundary_faces.size());
    }
  }
}

TEST(MshMutation, DamagedFilesAreRefusedOrGiveASoundMesh) {
  int n_refused = 0, n_read = 0;
  for (size_t f = 0; f < block_files.size(); ++f) {
    const std::string good = bytes_of_file(block_path(block_files[f]));
    ASSERT_GT(good.size(), 1000u);
    for (int trial = 0; trial < 1500; ++trial) {
      Chance chance(1000000 * f + trial);
      std::string bytes = good;
      for (size_t n = 1 + chance.below(3); n > 0; --n)
        damage(bytes, chance);
      try {
        expect_sound(msh::read_msh_bytes(bytes, "mutated.msh"));
        ++n_read;
      } catch (const base::InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("mutated.msh", 0), 0u) << error.what();
        ++n_refused;
      }
    }
  }
  // The damage must reach both ends: harmless changes (a shifted node) and broken files.
  EXPECT_GT(n_refused, 3000);
  EXPECT_GT(n_read, 100);
}

}  // namespace
}  // namespace diptych::meshes
