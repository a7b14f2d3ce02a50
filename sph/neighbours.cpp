#include "sph/neighbours.hpp"

#include "common/parallel/for_each.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace diptych::sph {

namespace {

using Cell = std::array<std::int64_t, 3>;

/// The particles whose radius lies in one octave, sorted by the cell of a grid that they are in.
struct Octave {
  double radius = 0;  ///< largest
  double edge = 0;    ///< of a grid cell
  Vec3 lower = Vec3::Zero();
  Cell n{1, 1, 1};
  std::vector<std::int64_t> first;  ///< [n0*n1*n2 + 1] into the two below
  std::vector<std::int32_t> particle;
  std::vector<Vec3> X;  ///< of those particles, for locality
  std::vector<double> particle_radius;

  Cell cell_of(const Vec3& x) const {
    Cell c;
    for (int i = 0; i < 3; ++i) {
      const double place = std::floor((x[i] - lower[i]) / edge);
      c[i] = static_cast<std::int64_t>(std::clamp(place, 0.0, static_cast<double>(n[i] - 1)));
    }
    return c;
  }
  std::int64_t index(const Cell& c) const { return (c[2] * n[1] + c[1]) * n[0] + c[0]; }
};

/// Grid cells half as wide as the radius, wider where that would leave most of them empty.
void set_grid(Octave& octave, const std::vector<Vec3>& X) {
  Vec3 upper = X[octave.particle.front()];
  octave.lower = upper;
  for (std::int32_t a : octave.particle) {
    octave.lower = octave.lower.cwiseMin(X[a]);
    upper = upper.cwiseMax(X[a]);
  }
  const double most = 4.0 * static_cast<double>(octave.particle.size()) + 64;
  octave.edge = 0.5 * octave.radius;
  const auto count = [&](int i) {
    return std::floor((upper[i] - octave.lower[i]) / octave.edge) + 1;
  };
  while (count(0) * count(1) * count(2) > most)
    octave.edge *= 1.25;
  for (int i = 0; i < 3; ++i)
    octave.n[i] = static_cast<std::int64_t>(count(i));
}

void sort_into_grid(Octave& octave, const std::vector<Vec3>& X, const std::vector<double>& radius) {
  set_grid(octave, X);
  octave.first.assign(static_cast<size_t>(octave.n[0] * octave.n[1] * octave.n[2]) + 1, 0);
  for (std::int32_t a : octave.particle)
    ++octave.first[octave.index(octave.cell_of(X[a])) + 1];
  for (size_t c = 1; c < octave.first.size(); ++c)
    octave.first[c] += octave.first[c - 1];
  std::vector<std::int64_t> next(octave.first.begin(), octave.first.end() - 1);
  std::vector<std::int32_t> sorted(octave.particle.size());
  for (std::int32_t a : octave.particle)
    sorted[next[octave.index(octave.cell_of(X[a]))]++] = a;
  octave.particle = std::move(sorted);
  octave.X.reserve(octave.particle.size());
  octave.particle_radius.reserve(octave.particle.size());
  for (std::int32_t a : octave.particle) {
    octave.X.push_back(X[a]);
    octave.particle_radius.push_back(radius[a]);
  }
}

std::vector<Octave> sorted_octaves(const std::vector<Vec3>& X, const std::vector<double>& radius) {
  const auto [least, most] = std::minmax_element(radius.begin(), radius.end());
  const int first = std::ilogb(*least);
  std::vector<Octave> octaves(static_cast<size_t>(std::ilogb(*most) - first) + 1);
  for (size_t a = 0; a < X.size(); ++a) {
    Octave& octave = octaves[std::ilogb(radius[a]) - first];
    octave.particle.push_back(static_cast<std::int32_t>(a));
    octave.radius = std::max(octave.radius, radius[a]);
  }
  std::erase_if(octaves, [](const Octave& octave) { return octave.particle.empty(); });
  for (Octave& octave : octaves)
    sort_into_grid(octave, X, radius);
  return octaves;
}

void add_from(const Octave& octave,
              std::int32_t a,
              const Vec3& X,
              double radius,
              std::vector<std::int32_t>& found) {
  const double reach = 0.5 * (radius + octave.radius);
  const Cell from = octave.cell_of(X - Vec3::Constant(reach));
  const Cell to = octave.cell_of(X + Vec3::Constant(reach));
  for (std::int64_t z = from[2]; z <= to[2]; ++z) {
    for (std::int64_t y = from[1]; y <= to[1]; ++y) {
      const std::int64_t begin = octave.first[octave.index({from[0], y, z})];
      const std::int64_t end = octave.first[octave.index({to[0], y, z}) + 1];
      for (std::int64_t s = begin; s < end; ++s) {
        const double r_ab = 0.5 * (radius + octave.particle_radius[s]);
        if ((octave.X[s] - X).squaredNorm() < r_ab * r_ab && octave.particle[s] != a) {
          found.push_back(octave.particle[s]);
        }
      }
    }
  }
}

/// Particles that are searched for by one thread at a time.
constexpr std::int64_t piece_size = 2048;

}  // namespace

Rows find_neighbours(const std::vector<Vec3>& X, const std::vector<double>& radius) {
  if (X.empty()) return {{0}, {}};
  const std::vector<Octave> octaves = sorted_octaves(X, radius);
  const auto n = static_cast<std::int64_t>(X.size());
  std::vector<std::vector<std::int32_t>> pieces(
      static_cast<size_t>((n + piece_size - 1) / piece_size));
  Rows rows;
  rows.row.assign(X.size() + 1, 0);
  const auto for_pieces = [&](const auto& work) {
    parallel::for_each(static_cast<std::int64_t>(pieces.size()), [&](std::int64_t i) {
      work(pieces[i], i * piece_size, std::min(n, (i + 1) * piece_size));
    });
  };
  for_pieces([&](std::vector<std::int32_t>& found, std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const auto first = static_cast<std::ptrdiff_t>(found.size());
      for (const Octave& octave : octaves)
        add_from(octave, static_cast<std::int32_t>(a), X[a], radius[a], found);
      std::sort(found.begin() + first, found.end());
      rows.row[a + 1] = static_cast<std::int64_t>(found.size()) - first;
    }
  });
  std::partial_sum(rows.row.begin(), rows.row.end(), rows.row.begin());
  rows.neighbour.resize(static_cast<size_t>(rows.row.back()));
  for_pieces([&](std::vector<std::int32_t>& found, std::int64_t begin, std::int64_t) {
    std::copy(found.begin(), found.end(), rows.neighbour.begin() + rows.row[begin]);
    std::vector<std::int32_t>().swap(found);
  });
  return rows;
}

}  // namespace diptych::sph
