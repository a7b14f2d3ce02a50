#pragma once
/// Cells of the deformed mesh at the output times: those that have turned inside out, which no
/// nodal J shows (meshes/deformed_cells.hpp). Whether that ends the run: cell_guard.hpp

#include "common/io/run_record.hpp"
#include "common/run/observers/observer.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace diptych::run {

/// Of all cells, the least deformed over reference volume, and how many have none or less.
struct LeastCell {
  double J = 1;
  std::int64_t n_inverted = 0;
  std::int64_t n_cells = 0;
  algebra::Vec3 centre = algebra::Vec3::Zero();  ///< m, undeformed, of the cell with that J
  std::int32_t node = 0;                         ///< a corner of it
  std::int64_t n_folded = 0;                     ///< of the others, those with a corner inside out
  algebra::Vec3 folded = algebra::Vec3::Zero();  ///< m, undeformed, centre of the first of them

  /// Of a breakdown: how many are inside out, where the worst of them is, what to do.
  std::string message(std::int64_t step, double time) const;
};

class Cells : public Observer {
 public:
  using Least = std::function<LeastCell()>;
  using Seen = std::function<const LeastCell*(std::int64_t step)>;

  /// @param least  of the body as it stands
  /// @param seen  what is known of the cells at the end of a step, else null; may be empty
  explicit Cells(Least least, Seen seen = {}) : least_(std::move(least)), seen_(std::move(seen)) {}

  void at_output(const Output& output) override;
  void at_breakdown(const Output& output) override { at_output(output); }
  void archive(algebra::Archive& archive) override;
  /// At the last output time.
  const LeastCell& now() const { return now_; }
  /// Least of all output times, most inverted ones, the first time with such.
  void fill(io::RunSummary& summary) const;
  /// What is to be told of cells that were folded at an output time.
  std::optional<std::string> notice() const;

 private:
  Least least_;
  Seen seen_;
  LeastCell now_;
  double least_J_ = 1e300;
  std::int64_t most_inverted_ = 0;
  std::optional<double> inverted_from_;  // s
  LeastCell most_folded_;
  double most_folded_at_ = 0, folded_from_ = 0;  // s
};

}  // namespace diptych::run
