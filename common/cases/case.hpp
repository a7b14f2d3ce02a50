#pragma once
/// A case as plain structs: what a case file says once every key has been checked. Units are SI
/// unless the user keeps another consistent system; each key's unit stands in its
/// entry in sections/, from which `diptych explain` and the reference page are made. Defaults stand
/// here.

#include "common/algebra/vectors.hpp"
#include "common/cases/probe_fields.hpp"
#include "common/exact/manufactured/motion.hpp"
#include "common/functions/expressions.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cases {

using algebra::Vec3;

/// [mesh]: a box of the generator, a Gmsh .msh file, or a .geo file meshed by the gmsh program.
struct MeshCase {
  std::string generator = "box";       ///< "box" where no file is given
  std::string file;                    ///< resolved path of a .msh or .geo file, or empty
  std::string element = "hexahedron";  ///< hexahedron, tetrahedron, quadrilateral, triangle
  Vec3 lower = Vec3::Zero();           ///< m
  Vec3 upper = Vec3::Ones();           ///< m
  std::array<int, 3> cells{4, 4, 4};   ///< at level 0; level L has cells * 2^L
  double size = 0;                     ///< m, element size at level 0 for .geo files (h / 2^L)
  double perturbation = 0;             ///< interior nodes moved at random, fraction of spacing
  std::uint64_t seed = 1;              ///< of that random shift
};

/// One Maxwell branch: xi^alpha = beta_C xi, zeta^alpha = beta_G zeta.
struct BranchCase {
  double beta_C = 0;  ///< > 0, or 0 where absent
  double tau_C = 1;   ///< s, > 0
  double beta_G = 0;
  double tau_G = 1;
};

/// [material]. lame and shear follow from the pair of constants the user gave.
struct MaterialCase {
  std::string model = "mooney-rivlin";  ///< entry of the material menu
  double density = 0;                   ///< kg/m^3, > 0
  double shear_modulus = 0;             ///< Pa, mu > 0
  double lame = 0;                      ///< Pa, lambda
  double zeta_ratio = 0;  ///< zeta / (xi + zeta) in [0, 1): 0 neo-Hookean, 0.5 xi = zeta
  std::vector<BranchCase> branches;
};

/// [[boundary]]
struct BoundaryCase {
  std::vector<std::string> groups;    ///< mesh groups
  std::string type;                   ///< entry of the boundary menu
  functions::VectorExpression value;  ///< traction (Pa, dead, per reference area) or velocity (m/s)
  bool manufactured = false;          ///< traction or velocity of the manufactured motion instead
  functions::Expression pressure;     ///< Pa, follower pressure
  Vec3 point = Vec3::Zero();          ///< m, of a rigid wall
  Vec3 normal = Vec3::Zero();         ///< of a rigid wall, towards the body
  functions::SourcePlace where;  ///< of the table, for messages about groups that the mesh lacks
};

/// [initial]. With a manufactured motion displacement and velocity are its own.
struct InitialCase {
  functions::VectorExpression displacement;  ///< m; F is its discrete gradient unless given below
  functions::VectorExpression velocity;      ///< m/s
  std::optional<functions::TensorExpression> deformation_gradient;
  std::shared_ptr<const exact::Motion> motion;  ///< of [manufactured], or null
  bool relaxed = false;  ///< internal variables: "virgin" (A = S = I) or "relaxed" (at equilibrium)
  double velocity_noise = 0;  ///< m/s, greatest random addition to v: not a key, for studies
};

/// [time]
struct TimeCase {
  double end = 0;                       ///< s, > 0
  std::string integrator = "leapfrog";  ///< entry of the integrator menu
  double cfl = 0;                     ///< fraction of the graph bound; 0: default of the integrator
  std::string speeds = "exact";       ///< of the time step: exact, bound or linearised
  std::int64_t max_steps = 0;         ///< 0: none
  int max_retries = 5;                ///< of one step, each with half its size
  std::int64_t checkpoint_every = 0;  ///< steps; 0: not by steps
  double checkpoint_seconds = 0;      ///< of the clock; 0: not by the clock
  double checkpoint_interval = 0;     ///< s, of the scene; 0: not by its time
};

/// [guards]
struct GuardsCase {
  double energy_residual = 0.01;        ///< > 0, share of the largest energy so far
  double numerical_dissipation = 0;     ///< the same, 1: any; 0: 0.5, with a limiter of shocks any
  double involution = 0.01;             ///< > 0, |H - cof F| and |J - det F|
  double angular_drift = 0.2;           ///< > 0, share of the largest sum of |x||p| so far
  double volumes_apart = 0.2;           ///< > 0, share of the body's volume
  double least_step = 1e-7;             ///< > 0, share of the first step
  std::string inverted_cells = "stop";  ///< stop or warn
};

/// [output]
struct OutputCase {
  int frames = 10;     ///< output instants after t = 0, evenly spaced, last at end
  bool fields = true;  ///< write field files
};

/// [[probe]]
struct ProbeCase {
  std::string name, unit;
  std::string kind = "point";           ///< see probe.kind
  functions::Expression quantity;       ///< of the fields of `fields` and of place and time
  std::shared_ptr<ProbeFields> fields;  ///< what the expression reads
  Vec3 at = Vec3::Zero();               ///< m
  std::vector<std::string> groups;      ///< empty: the body
  /// Of place alone; it looks at nodes where this is not 0.
  std::optional<functions::Expression> region;
  Vec3 direction = Vec3::Zero();  ///< of a reaction
  bool every_step = false;
  bool oscillation = false;  ///< read period and decrement
  functions::SourcePlace where;

  std::string column() const { return name + " [" + unit + "]"; }
};

/// [[reference]]: values of a probe from elsewhere, which runs are held against.
struct ReferenceCase {
  std::string probe;                          ///< name of a probe of the case
  std::string source;                         ///< where they are from
  std::vector<std::array<double, 2>> points;  ///< s, unit of the probe, in the order of time
  std::optional<double> uncertainty;          ///< of all of them, unit of the probe
};

/// [scheme]
struct SchemeCase {
  std::string unknowns = "FHJ";         ///< F, FJ or FHJ
  std::string reconstruction = "auto";  ///< of scheme::reconstruction_menu()
  std::string limiter = "none";         ///< entry of the limiter menu
  std::string impedance = "isotropic";  ///< isotropic or exact
  double dissipation = 1;               ///< multiplies D_ab, >= 0
  double face_correction = 0;           ///< kappa_f of notes 3.8, 0: none
  std::string volumes = "auto";         ///< auto, cells or nodes: scheme::Volumes
  double cell_shear = 0.5;              ///< share of mu by gradients of cells, where they are
  double hourglass = 5;                 ///< stiffness of edges over mu, where it is needed
  std::string precision = "double";     ///< double, mixed or single: scheme::Precision
  bool angular_momentum_projection = false;
};

/// [sph]
struct SphCase {
  std::string kernel = "cubic-spline";
  double kappa = 1.2;             ///< h_a = kappa (Omega_a / filled part of the angle)^(1/d)
  bool closure = true;            ///< repair of the closure, notes 3.3
  std::string gradient = "auto";  ///< corrected (first order), sbp (operators that sum by
                                  ///< parts), or auto: sbp where the mesh takes it
};

/// [fvm]
struct FvmCase {
  std::string stencil =
      "auto";     ///< edge (nodal quadrature), integral (2 int N_a grad N_b dV),
                  ///< sbp (operators that sum by parts), or auto: sbp where the mesh takes it
  int order = 4;  ///< of sbp, inside: 2, 4 or 6
};

/// [exact]: solution the run is measured against. Missing fields are derived from displacement.
struct ExactCase {
  std::optional<functions::VectorExpression> displacement;          ///< m
  std::optional<functions::VectorExpression> velocity;              ///< m/s
  std::optional<functions::TensorExpression> deformation_gradient;  ///< -
  std::optional<functions::TensorExpression> stress;                ///< Pa, first Piola-Kirchhoff
};

/// One of expect.holds: a figure of the run and what it must not exceed, or fall below.
struct BoundCase {
  std::string text;    ///< as written: "energy residual <= 1e-2"
  std::string figure;  ///< see run_figures
  bool at_most = true;
  double value = 0;
  functions::SourcePlace where;

  bool is_met_by(double measured) const;  ///< false for what is no finite number
};

/// [[expect.unmet]]: who does not meet the pass numbers today, and how the run ends until then.
struct UnmetCase {
  std::string method, variant;  ///< variant: one of expect.variants, or empty
  std::string figure;           ///< the one bound that does not hold; empty: whichever do not
  std::string stops;            ///< part of the message that stops the run; empty: it ends
  std::int64_t by_step = 0;     ///< at the latest; 0: at any
  std::string because;
  functions::SourcePlace where;
};

/// [[variant]]: further settings that comparisons show as a column of their own beside the methods.
struct VariantCase {
  std::string name;
  std::string method;            ///< sph or fvm; empty: a column of either
  std::vector<std::string> set;  ///< "key=value"
  functions::SourcePlace where;
};

/// [expect]: the pass numbers of a case, which the regression asks of every run.
struct ExpectCase {
  bool is_given = false;
  std::vector<BoundCase> holds;
  std::vector<std::string> variants;  ///< "key=value", each beside the case as it stands
  std::string stops;                  ///< the run is to be stopped with this in its message
  std::int64_t by_step = 0;
  std::vector<UnmetCase> unmet;
};

/// [[apart]]: a quantity on which the methods differ by more than their error bars, and why.
struct ApartCase {
  std::string quantity;  ///< a probe, an energy, "min jacobian"
  std::string because;
};

/// [bounds]: what the regression asks of both methods at the size of the baseline.
struct BoundsCase {
  std::optional<double> numerical_dissipation;  ///< share of the largest energy
};

struct Case {
  std::string name;  ///< folder or file name of the case
  std::string file;  ///< absolute path; of a copy that a run left, that of its original
  std::string text;  ///< file as read; of a copy, that of its original
  std::string hash;  ///< of text and overrides
  std::string title;
  std::vector<std::string> overrides;  ///< "key=value" of --set and of a copy
  MeshCase mesh;
  MaterialCase material;
  InitialCase initial;
  std::vector<BoundaryCase> boundaries;
  functions::VectorExpression body_force;       ///< N/m^3 per reference volume
  std::shared_ptr<const exact::Motion> motion;  ///< of [manufactured], or null
  TimeCase time;
  GuardsCase guards;
  OutputCase output;
  std::vector<ProbeCase> probes;
  std::vector<ReferenceCase> references;
  SchemeCase scheme;
  SphCase sph;
  FvmCase fvm;
  ExactCase exact;
  BoundsCase bounds;
  std::vector<ApartCase> apart;
  ExpectCase expect;
  std::vector<VariantCase> variants;
};

}  // namespace diptych::cases
