#include "common/run/observers/cells.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::run {

std::string LeastCell::message(std::int64_t step, double time) const {
  return fmt::format(
      "{} of {} cells are inside out, step {}, time {:.6g} s\n"
      "  the worst (deformed over undeformed volume {:.3g}) had its centre at X = ({:.6g}, {:.6g}, "
      "{:.6g}) m\n"
      "  nodes are sound: the body has passed through itself between them, or these cells, whose "
      "edges stay straight, are too coarse or too thin for the motion; let cells carry pressure "
      "and "
      "part of the shear (scheme.volumes = \"cells\"), load more slowly, refine with rounder "
      "cells, "
      "or use the sign-preserving limiter; guards.inverted_cells = \"warn\" lets the run go on",
      n_inverted, n_cells, step, time, J, centre[0], centre[1], centre[2]);
}

void Cells::at_output(const Output& output) {
  const LeastCell* seen = seen_ ? seen_(output.step.step) : nullptr;
  now_ = seen ? *seen : least_();
  least_J_ = std::min(least_J_, now_.J);
  most_inverted_ = std::max(most_inverted_, now_.n_inverted);
  const double time = output.state.time();
  if (now_.n_inverted > 0 && !inverted_from_) inverted_from_ = time;
  if (now_.n_folded <= most_folded_.n_folded) return;
  if (most_folded_.n_folded == 0) folded_from_ = time;
  most_folded_ = now_;
  most_folded_at_ = time;
}

void Cells::archive(algebra::Archive& archive) {
  archive.real("cells/J", "-", now_.J);
  archive.integer("cells/inverted", now_.n_inverted);
  archive.integer("cells/number", now_.n_cells);
  archive.vector("cells/centre", "m", now_.centre);
  archive.real("cells/least J", "-", least_J_);
  archive.integer("cells/most inverted", most_inverted_);
  std::vector<double> from;
  if (inverted_from_) from.push_back(*inverted_from_);
  archive.reals("cells/inverted from", "s", from);
  inverted_from_ = from.empty() ? std::nullopt : std::optional(from.front());
  archive.integer("cells/folded", now_.n_folded);
  archive.vector("cells/first folded", "m", now_.folded);
  archive.integer("cells/most folded", most_folded_.n_folded);
  archive.vector("cells/first of most folded", "m", most_folded_.folded);
  archive.real("cells/most folded at", "s", most_folded_at_);
  archive.real("cells/folded from", "s", folded_from_);
}

std::optional<std::string> Cells::notice() const {
  if (most_folded_.n_folded == 0) return std::nullopt;
  const algebra::Vec3& X = most_folded_.folded;
  return fmt::format(
      "from t = {:.4g} s on cells were folded: {} of {} at t = {:.4g} s had a corner inside out, "
      "the first with its centre at X = ({:.4g}, {:.4g}, {:.4g}) m, though their volumes are "
      "positive; there the mesh is too coarse for the motion, or the load too sharp for the mesh",
      folded_from_, most_folded_.n_folded, now_.n_cells, most_folded_at_, X[0], X[1], X[2]);
}

void Cells::fill(io::RunSummary& summary) const {
  summary.least_cell_J = least_J_;
  summary.most_inverted_cells = most_inverted_;
  summary.inverted_from = inverted_from_;
}

}  // namespace diptych::run
