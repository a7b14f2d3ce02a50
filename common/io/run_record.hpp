#pragma once
/// What a run says of itself: summary.json (contract of the program: stable names, more may be
/// added), read back by the harness and the report.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace diptych::io {

/// Relative error norms of one field.
struct ErrorNorms {
  double l1 = 0, l2 = 0, linf = 0;
};

/// Joule (per metre of thickness in 2-D).
struct EnergySummary {
  double kinetic = 0, strain = 0, viscous_dissipation = 0, numerical_dissipation = 0;
  double external_work = 0, projection_work = 0;
  double relative_residual = 0;
};

struct Provenance {
  std::string version, commit, compiler, flags, cpu, instruction_set, date, case_hash;
  std::string program;     ///< hash of the executable that ran
  std::string input_hash;  ///< of case, overrides, mesh file and measures
};

/// A quantity of interest over a run. Extremes are those of the recorded instants.
struct QuantitySummary {
  std::string name, unit;
  double final_value = 0, least = 0, greatest = 0;
  // where it was to be read as an oscillation
  int n_periods = 0;                ///< 0: no whole one
  double period = 0;                ///< s, mean
  double mean = 0;                  ///< over whole periods
  double amplitude = 0;             ///< of the first period
  std::optional<double> decrement;  ///< logarithmic, a period; from two periods on
};

/// How far a probe is from values from elsewhere ([[reference]] of the case), at their times.
struct ReferenceSummary {
  std::string name;  ///< of the probe; "tip (2)" where it is the second one of that probe
  std::string probe, source;
  std::int64_t n_times = 0;           ///< instants at which both are known
  double until = 0;                   ///< s, the last of them
  double greatest = 0;                ///< largest |run - reference|, unit of the probe
  double greatest_at = 0;             ///< s
  double rms = 0;                     ///< root mean square of run - reference
  double at_end = 0;                  ///< run - reference at the last instant
  std::optional<double> uncertainty;  ///< that the reference states, unit of the probe

  /// Whether the run is within the stated uncertainty at every instant.
  bool is_inside() const { return uncertainty && greatest <= *uncertainty; }
};

/// Why a run has the status "breakdown" (with time, step, node and place where they are known) or
/// "failed" (full disk, no memory, an expression without a value).
struct RunFailure {
  std::string message;
  std::optional<double> time;                  ///< s, of the scene
  std::optional<std::int64_t> step;            ///< the one that was not finished
  std::optional<std::int64_t> node;            ///< its number in the user's mesh
  std::optional<std::array<double, 3>> place;  ///< m, reference position of the node
};

/// What a run is called beside others: "sph", or "sph-compact" where it is of a variant of the
/// case. Its folder has that name.
std::string column_name(const std::string& method, const std::string& variant);

struct RunSummary {
  std::string method, case_name, title;
  std::string variant;    ///< of the case, by its name; empty: the case as it stands
  std::string case_file;  ///< absolute path of the case file, which tells cases apart
  int level = 0, dimension = 3;
  std::int64_t nodes = 0, pairs = 0;
  int unknowns_per_node = 0;
  std::int64_t steps = 0, stages = 0;
  std::int64_t rejected_steps = 0;  ///< attempts that failed and were made again with half the size
  std::int64_t restarts = 0;        ///< how often it went on from a checkpoint
  // what acted beside the equations (scheme/budget/interventions.hpp)
  std::int64_t projections = 0, resynchronisations = 0, limited_pairs = 0;
  int threads = 1, ranks = 1;
  std::string precision = "double", integrator;
  std::string volumes = "nodes";  ///< what carries the bulk pressure: nodes, cells or lines
  /// running, done, unmet, unsound, step limit, interrupted, breakdown, failed. Unmet: it came to
  /// its end, and something that its case asks ([expect]) does not hold. Unsound: the same with
  /// cells inside out on the way, which the case allows (guards.inverted_cells = "warn").
  std::string status = "done";
  std::string unmet;  ///< "numerical share 0.02, asked <= 0.01", or empty
  std::optional<RunFailure> failure;
  std::string arrangement;  ///< of pairs in the sweeps: runs or rows
  double end_time = 0;
  double setup_seconds = 0, wall_seconds = 0, loop_seconds = 0, nanoseconds_per_node_stage = 0;
  /// per node for the time that a pressure wave of the undeformed body takes over one spacing
  double nanoseconds_per_node_crossing = 0;
  // of several ranks
  double imbalance = 1;              ///< largest work of a rank over the mean
  std::int64_t exchanged_bytes = 0;  ///< from rank to rank in steps
  double communication_seconds = 0;  ///< mean of the ranks, waiting included
  std::int64_t peak_rss_bytes = 0;
  std::int64_t solver_bytes = 0;        ///< arrays of the solver: state and geometry of the sweeps
  std::int64_t running_rss_bytes = 0;   ///< resident set of the program after the first step
  std::int64_t building_rss_bytes = 0;  ///< largest resident set until then
  double dt_min = 0, dt_max = 0;
  double spacing = 0;  ///< m, Omega^(1/d) of the mean interior node
  double mean_neighbours = 0;
  double graph_closure = 0, graph_linear_exactness = 0;
  std::string graph_operators;       ///< on which lines which order (fvm.stencil = "sbp"), or empty
  std::vector<std::string> notices;  ///< what set-up had to say of this scene
  std::map<std::string, ErrorNorms>
      errors;                              ///< velocity, displacement, deformation_gradient, stress
  std::map<std::string, double> measures;  ///< asked for by who started the run, at its end
  EnergySummary energy;
  /// J, that the body has held at any check, or that was brought in, in the frame of its centre of
  /// mass where nothing holds it; 0 where it is no more than rounding
  double largest_energy = 0;
  /// J, the same less the least strain energy of any check: what has moved of a body that is
  /// stretched to begin with; 0 where it is no more than rounding
  double mobile_energy = 0;
  double contact_loss =
      0;  ///< J, of the external work: what walls took of nodes as they caught them
  double linear_momentum_drift = 0, angular_momentum_drift = 0;  ///< largest over the output times
  double involution_H = 0, involution_J = 0;  ///< largest |H - cof F|, |J - det F| over them
  double min_jacobian = 1;                    ///< at the nodes, of all steps
  // of the cells of the mesh, at the output times: deformed over reference volume
  double least_cell_J = 1;
  std::int64_t most_inverted_cells = 0;
  std::optional<double> inverted_from;       ///< s, the first output time with such cells
  std::vector<QuantitySummary> quantities;   ///< [[probe]] of the case, in its order
  std::vector<ReferenceSummary> references;  ///< [[reference]] that the run has a time of
  std::string state_hash;
  Provenance provenance;

  std::string column() const { return column_name(method, variant); }
  /// It is of the whole time of its case, sound or not.
  bool is_ended() const { return status == "done" || status == "unmet" || status == "unsound"; }
};

/// JSON text with the key names of the contract: method, case, level, ..., steps, stages,
/// rejected_steps, restarts, interventions{projections,resynchronisations,limited_pairs}, ...,
/// dt{min,max}, errors{field{l1,l2,linf}}, energy{...}, largest_energy, mobile_energy,
/// contact_loss,
/// momentum{linear_drift,angular_drift}, involution{H,J}, min_jacobian,
/// cells{least_J,most_inverted,inverted_from}, state_hash, provenance{...}; where the case has
/// values from elsewhere references{name{probe,source,times,
/// until,greatest,greatest_at,rms,at_end,uncertainty}}; where the run was not finished,
/// failure{message,time,step,node,place}; where pass numbers of the case do not hold, unmet; of a
/// variant its name.
std::string to_json(const RunSummary& summary);

/// @throws base::InputError on malformed text, a missing key, NaN
RunSummary summary_from_json(const std::string& text, const std::string& path);

/// Whose results a summary.json is of; it need not be whole.
struct SummaryOwner {
  std::string case_name, case_file;  ///< case_file: empty in summaries of earlier versions
  std::string column;                ///< see RunSummary
};
/// Nothing where the text is no summary.
std::optional<SummaryOwner> summary_owner(const std::string& text);

/// Writes text to path.tmp, fsyncs, renames. @throws base::EnvironmentError with path and errno
void write_file_atomically(const std::string& path, const std::string& text);
std::string read_file(const std::string& path);  ///< @throws base::EnvironmentError

/// One row per output time.
struct HistoryRow {
  double time = 0;
  std::int64_t step = 0;
  double dt = 0;
  EnergySummary energy;
  double linear_momentum[3] = {0, 0, 0};
  double angular_momentum[3] = {0, 0, 0};
  double min_jacobian = 1;
  double involution_H = 0;  ///< max |H - cof F|
  double involution_J = 0;  ///< max |J - det F|
  double least_cell_J = 1;  ///< least deformed over reference volume of a cell
  std::vector<double> probes;
};

/// use(value) of all numbers of a row but for its step and its probes, in the order of history.csv.
template <class Use>
void for_each_value(HistoryRow& row, const Use& use) {
  EnergySummary& energy = row.energy;
  for (double* value :
       {&row.time, &row.dt, &energy.kinetic, &energy.strain, &energy.viscous_dissipation,
        &energy.numerical_dissipation, &energy.external_work, &energy.projection_work,
        &energy.relative_residual, &row.linear_momentum[0], &row.linear_momentum[1],
        &row.linear_momentum[2], &row.angular_momentum[0], &row.angular_momentum[1],
        &row.angular_momentum[2], &row.min_jacobian, &row.involution_H, &row.involution_J,
        &row.least_cell_J})
    use(*value);
}

/// history.csv and steps.csv are these header lines and these lines, one below the other.
std::string history_header(const std::vector<std::string>& probe_names);
std::string history_line(const HistoryRow& row);

/// CSV with a header line of names with units in brackets, e.g. "time [s]".
std::string history_csv(const std::vector<HistoryRow>& rows,
                        const std::vector<std::string>& probe_names);
std::vector<HistoryRow> history_from_csv(const std::string& text, const std::string& path);

/// steps.csv: the probes that are evaluated after every step; rows of time, number and values.
struct StepRow {
  double time = 0;
  std::int64_t step = 0;
  std::vector<double> probes;
};
std::string steps_header(const std::vector<std::string>& probe_names);
std::string steps_line(const StepRow& row);
std::string steps_csv(const std::vector<StepRow>& rows,
                      const std::vector<std::string>& probe_names);

/// Names of the probe columns, in the order of HistoryRow::probes.
std::vector<std::string> probe_names_from_csv(const std::string& text, const std::string& path);

/// A column of history.csv: "kinetic energy [J]" has the name "kinetic energy" and the unit "J".
struct HistoryColumn {
  std::string name, unit;  ///< unit "-" where there is none
  std::vector<double> values;
};

/// Every column of the file, whatever their names.
/// @throws base::InputError on malformed text and on what is no finite number
std::vector<HistoryColumn> history_columns_from_csv(const std::string& text,
                                                    const std::string& path);

/// exact.csv: what the exact solution of the case gives at the output times; columns as those of
/// history.csv, "time [s]" first, only those that are known.
std::string columns_csv(const std::vector<HistoryColumn>& columns);
std::vector<HistoryColumn> columns_from_csv(const std::string& text, const std::string& path);

}  // namespace diptych::io
