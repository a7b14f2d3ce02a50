#include "common/run/observers/volume_guard.hpp"

#include "common/base/error.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::run {

namespace {

constexpr const char* what_to_do =
    "the mesh is too coarse for how fast the strain changes, as beside clamped sides, at edges and "
    "corners; use a finer one (--level), finite volumes, or let nodes carry the pressure "
    "(scheme.volumes = \"nodes\")";

/// The node whose J is farthest from the volume that carries the pressure there.
size_t worst_node(const Snapshot& s) {
  size_t worst = 0;
  double most = -1;
  for (size_t a = 0; a < s.F.size(); ++a) {
    const double apart = std::abs(s.F[a].determinant() - s.J[a]);
    if (apart <= most) continue;  // of what is no number the first
    worst = a;
    if (std::isnan(apart)) break;
    most = apart;
  }
  return worst;
}

}  // namespace

void VolumeGuard::at_check(const Check& check) {
  const double apart = check.balance.volumes_apart();
  if (apart > largest_) {
    largest_ = apart;
    time_ = check.step.time;
  }
  if (apart <= threshold_) return;
  const Snapshot state = solver_.snapshot();
  const size_t a = worst_node(state);
  const std::string message = fmt::format(
      "J of the nodes has left the volumes that carry the pressure, by {:.3g} of the body's "
      "volume, "
      "bound {:g}: farthest at node {}, {:.3g} and {:.3g}, step {}, time {:.6g} s, dt {:.4g} s\n"
      "  {}; guards.volumes_apart raises the bound",
      apart, threshold_, a, state.F[a].determinant(), state.J[a], check.step.step, check.step.time,
      check.step.dt, what_to_do);
  throw base::BreakdownError(message, static_cast<std::int32_t>(a));
}

void VolumeGuard::archive(algebra::Archive& archive) {
  archive.real("volume guard/largest", "-", largest_);
  archive.real("volume guard/time", "s", time_);
}

std::optional<std::string> VolumeGuard::notice() const {
  if (largest_ <= worth_telling || largest_ > threshold_) return std::nullopt;
  return fmt::format(
      "J of the nodes and the volumes that carry the pressure were up to {:.2g} of the body's "
      "volume apart (at {:.4g} s), so that energies and reactions may err by some per cent, on a "
      "few cells by half: {}",
      largest_, time_, what_to_do);
}

}  // namespace diptych::run
