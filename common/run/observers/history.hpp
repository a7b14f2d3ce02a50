#pragma once
/// The rows of history.csv: energies, momenta, involutions, probes and the least cell at the output
/// times; what they come to for the summary. Where they go to a file, a kill leaves every row until
/// the last output time. Test: tests/command_line/killed_test.cpp

#include "common/io/row_file.hpp"
#include "common/io/run_record.hpp"
#include "common/run/energy_record.hpp"
#include "common/run/momentum_record.hpp"
#include "common/run/observers/cells.hpp"
#include "common/run/probes.hpp"

#include <memory>
#include <string>
#include <vector>

namespace diptych::run {

class History : public Observer {
 public:
  /// @param solver, probes, cells  kept by reference; `cells` is told of an output before this one
  History(Solver& solver,
          const Probes& probes,
          const Cells& cells,
          const EnergyUnits& units = {},
          const MomentumUnits& rounding = {});

  /// The rows so far, and those from now on, go to this file too.
  /// @param columns  headers of the probes, see probe_columns
  /// @throws base::EnvironmentError
  void write_to(const std::string& path, const std::vector<std::string>& columns);

  void at_output(const Output& output) override;
  void at_check(const Check& check) override {
    momenta_.note_scales(check.balance);
    energy_.at(check.balance, check.audit);
  }
  void at_breakdown(const Output& output) override { at_output(output); }
  /// The file is on the disk.
  void end(Ending ending) override;
  void archive(algebra::Archive& archive) override;

  const std::vector<io::HistoryRow>& rows() const { return rows_; }
  std::vector<io::HistoryRow> take_rows() { return std::move(rows_); }
  /// Of the body as it is now, relative.
  double energy_residual() const;
  /// Energies at the last output, largest drifts and involutions. @pre there was an output
  void fill(io::RunSummary& summary) const;

 private:
  Solver& solver_;
  const Probes& probes_;
  const Cells& cells_;
  EnergyRecord energy_;
  MomentumRecord momenta_;
  std::vector<io::HistoryRow> rows_;
  std::unique_ptr<io::RowFile> file_;
  double linear_drift_ = 0, angular_drift_ = 0;  // largest so far
};

}  // namespace diptych::run
