/// The table. Explanations and look-ups are in case_explain.cpp.

#include "common/cases/keys.hpp"

namespace diptych::cases {

namespace {

using enum KeyType;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Range any{};
constexpr Range above(double least) {
  return {least, infinite, false, false};
}
constexpr Range at_least(double least) {
  return {least, infinite, true, false};
}
constexpr Range between(double least, double most) {
  return {least, most, true, true};
}
constexpr std::string_view required = "required";

// Entries without a menu, with one, and with advice, so that each stays short.
constexpr Key key(std::string_view path,
                  KeyType type,
                  std::string_view unit,
                  std::string_view standard,
                  std::string_view need,
                  Range range,
                  std::string_view meaning,
                  std::string_view example,
                  std::string_view advice = "") {
  return {path, type, unit, standard, need, range, {}, meaning, example, advice};
}
constexpr Key choice(std::string_view path,
                     std::string_view standard,
                     std::string_view need,
                     std::span<const std::string_view> menu,
                     std::string_view meaning,
                     std::string_view example) {
  return {path, name, "-", standard, need, any, menu, meaning, example, ""};
}

constexpr std::array section_table{
    Section{"parameters", false,
            "Numbers with names, in order: each may use the ones before it, all later keys may use "
            "them in expressions."},
    Section{
        "functions.*", false,
        "A function of time, or of place and time, that later expressions may use under the name "
        "of its section, here NAME. expression gives NAME. "
        "zener_mode gives NAME (amplitude q), NAME_dot, NAME_ddot and NAME_1 ... NAME_n "
        "(branch strains q_a) of rho q'' + k2 [M q + sum M_a (q - q_a)] = 0, "
        "q_a' = (q - q_a)/tau_a. "
        "zener_slab and zener_wave give NAME (displacement), NAME_v, NAME_strain, NAME_stress "
        "of small waves along x in that solid, virgin and at rest at t = 0: in 0 <= x <= length "
        "held at x = 0 with the stress signal(t) at x = length, or in x >= 0 with the velocity "
        "signal(t) at x = 0; NAME_speed, NAME_attenuation of the steady wave. "
        "uniaxial_wave gives NAME (displacement), NAME_v, NAME_f, NAME_P, NAME_f_wall, "
        "NAME_P_wall, NAME_speed of the elastic half space x >= 0 in uniaxial strain that moves "
        "at a velocity and is held at x = 0: a shock where it is negative, else a fan."},
    Section{"mesh", false, "The body: a box made here, or a mesh file."},
    Section{"material", false,
            "The solid; the elastic constants are one pair of youngs_modulus + poissons_ratio, "
            "shear_modulus + lame, or shear_modulus + bulk_modulus."},
    Section{"material.branch", true,
            "A Maxwell branch: xi^a = beta_C xi relaxing with tau_C, zeta^a = beta_G zeta relaxing "
            "with tau_G; at least one of the two."},
    Section{"initial", false, "The state at t = 0."},
    Section{"manufactured", false,
            "A motion that the body is made to follow (manufactured solution): body force, initial "
            "values, boundary values and exact fields are derived from it."},
    Section{"boundary", true,
            "A boundary condition on groups of the mesh; what no entry names is free."},
    Section{"load", false, "Loads on the whole body."},
    Section{"time", false, "How long and how."},
    Section{"output", false, "What is written."},
    Section{"probe", true,
            "A quantity of interest: a column of history.csv, an entry of summary.json, a value in "
            "each field file."},
    Section{"reference", true,
            "Values of a probe from elsewhere (literature, another code): the report draws them as "
            "points beside the curves of both methods."},
    Section{"scheme", false, "The scheme that both methods share."},
    Section{"sph", false, "What only SPH needs."},
    Section{"fvm", false, "What only the finite volumes need."},
    Section{"exact", false,
            "The exact solution; errors are measured against it. Fields that are missing are "
            "derived from the displacement."},
    Section{"record", false,
            "Of the copy of a case file that a run leaves among its results; not for other files."},
};

// One entry after the other, packed.
// clang-format off
constexpr std::array key_table{
    key("title", text, "-", "\"\"", "", any, "One line that says what the case is.",
        "\"swinging cube, P mode\""),

    key("parameters.*", number, "-", "", "as you like", any,
        "A number that expressions may use by its name.", "17e6"),

    choice("functions.*.type", "", required, menus::functions, "Kind of function.",
           "\"zener_mode\""),
    key("functions.*.value", scalar_field, "-", "", "with expression", any,
        "What the name stands for.", "\"sin(pi*t/T)^2\""),
    key("functions.*.wave_number_squared", number, "1/m^2", "", "with zener_mode", above(0),
        "Square k2 of the wave number |k| of the mode.", "\"3*pi^2/4\""),
    key("functions.*.density", number, "kg/m^3", "", "required but with expression", above(0),
        "Density rho.", "1100"),
    key("functions.*.modulus", number, "Pa", "", "with zener_*", above(0),
        "Equilibrium modulus M of the mode: lambda + 2 mu for a pressure wave, mu for a shear "
        "wave.", "22.885e6"),
    key("functions.*.branch_moduli", numbers, "Pa", "[]", "", above(0),
        "Moduli M_a of the branches: 4 xi^a and 8 zeta^a (pressure), 2 xi^a and 2 zeta^a (shear).",
        "[3.269e6, 6.538e6]"),
    key("functions.*.branch_times", numbers, "s", "[]", "", above(0),
        "Relaxation times tau_a, as many as branch_moduli.", "[2e-3, 1e-3]"),
    key("functions.*.amplitude", number, "-, Pa, m/s", "0", "", any,
        "q at t = 0 (zener_mode), or size of the signal: stress (zener_slab), velocity "
        "(zener_wave).", "5e-4"),
    key("functions.*.rate", number, "1/s", "0", "", any, "Rate of q at t = 0.", "0"),
    key("functions.*.relaxed", flag, "-", "false", "", any,
        "Branches start at q_a = q (true) or at q_a = 0 (false).", "true"),
    key("functions.*.length", number, "m", "", "with zener_slab", above(0), "Length of the slab.",
        "1"),
    choice("functions.*.signal", "\"step\"", "", menus::signals,
           "Load: amplitude times 1, 1 - cos(omega t), or sin(omega t) (1 - exp(-ramp_rate t))^3.",
           "\"sine\""),
    key("functions.*.angular_frequency", number, "1/s", "", "with an oscillating signal", above(0),
        "omega of the signal.", "200"),
    key("functions.*.ramp_rate", number, "1/s", "", "with signal = \"sine\"", above(0),
        "How fast the signal comes up.", "100"),
    key("functions.*.shear_modulus", number, "Pa", "", "with uniaxial_wave", above(0),
        "Shear modulus mu.", "6.54e6"),
    key("functions.*.lame", number, "Pa", "", "with uniaxial_wave", above(0),
        "First Lame constant lambda.", "9.81e6"),
    key("functions.*.zeta_ratio", number, "-", "0", "", Range{0, 1, true, false},
        "zeta/(xi + zeta) of the Mooney-Rivlin solid.", "0.5"),
    key("functions.*.velocity", number, "m/s", "", "with uniaxial_wave", any,
        "Velocity of the body before x = 0 is held; not 0.", "-10"),

    choice("mesh.element", "\"hexahedron\"", "required with mesh.file", menus::elements,
           "Cell type; the last two make the case 2-D (plane strain), and then all vectors have "
           "two entries.", "\"tetrahedron\""),
    key("mesh.file", path, "-", "", "optional, instead of a box", any,
        "Mesh to read (.msh) or to make with gmsh (.geo), relative to the case file.",
        "\"column.geo\""),
    key("mesh.lower", KeyType::vector, "m", "[0, 0, 0]", "", any, "Lower corner of the box.",
        "[-0.5, -0.5, 0]"),
    key("mesh.upper", KeyType::vector, "m", "[1, 1, 1]", "", any, "Upper corner of the box.",
        "[0.5, 0.5, 6]"),
    key("mesh.cells", counts, "-", "", "required for a box", between(1, 1e6),
        "Cells in each direction at level 0; level L has 2^L times as many.", "[4, 4, 24]"),
    key("mesh.size", number, "m", "", "required for a .geo file", above(0),
        "Element size at level 0; level L has size / 2^L.", "0.1"),
    key("mesh.perturbation", number, "-", "0", "", Range{0, 0.5, true, false},
        "Random shift of interior nodes as a fraction of the local spacing.", "0.2"),
    key("mesh.seed", integer, "-", "1", "", at_least(0),
        "Seed of the random shift; the same seed gives the same mesh everywhere.", "7"),

    choice("material.model", "\"mooney-rivlin\"", "", menus::models,
           "Law at equilibrium: Mooney-Rivlin of the paper, its limit zeta = 0, or the "
           "isochoric-split neo-Hookean laws with pressure K (J - 1) and K/2 (J^2 - 1)/J.",
           "\"neo-hookean\""),
    key("material.density", number, "kg/m^3", "", required, above(0),
        "Density rho_R of the undeformed body.", "1100"),
    key("material.youngs_modulus", number, "Pa", "", "with poissons_ratio", above(0),
        "Young's modulus E of small strains.", "17e6"),
    key("material.poissons_ratio", number, "-", "", "with youngs_modulus",
        Range{-1, 0.5, false, false}, "Poisson's ratio nu of small strains.", "0.3",
        "the model is compressible: use at most 0.4999 for a nearly incompressible solid"),
    key("material.shear_modulus", number, "Pa", "", "with lame or bulk_modulus", above(0),
        "Shear modulus mu of small strains.", "6.54e6"),
    key("material.lame", number, "Pa", "", "with shear_modulus", any, "First Lame constant lambda.",
        "9.81e6"),
    key("material.bulk_modulus", number, "Pa", "", "with shear_modulus", above(0),
        "Bulk modulus K = lambda + 2 mu / 3.", "14.2e6"),
    key("material.zeta_ratio", number, "-", "", "required for mooney-rivlin",
        Range{0, 1, true, false},
        "zeta/(xi + zeta), the share of the area term; admissible below lambda/(2 mu), where "
        "lambda_hat = lambda - 4 zeta > 0 (polyconvexity, eq. 4).", "0.5"),
    key("material.branch.beta_C", number, "-", "", "with tau_C", above(0), "xi^a / xi.", "0.5"),
    key("material.branch.tau_C", number, "s", "", "with beta_C", above(0),
        "Relaxation time of C_v^-1.", "2e-3"),
    key("material.branch.beta_G", number, "-", "", "with tau_G, where zeta > 0", above(0),
        "zeta^a / zeta.", "0.5"),
    key("material.branch.tau_G", number, "s", "", "with beta_G", above(0),
        "Relaxation time of G_v^-1.", "1e-3"),

    key("initial.displacement", vector_field, "m", "[0, 0, 0]", "", any,
        "Displacement at t = 0; F is its discrete gradient unless deformation_gradient is given.",
        "[\"1e-3*x\", 0, 0]"),
    key("initial.velocity", vector_field, "m/s", "[0, 0, 0]", "", any, "Velocity at t = 0.",
        "[\"10*z/6\", 0, 0]"),
    key("initial.deformation_gradient", tensor_field, "-", "", "optional", any,
        "F at t = 0, by rows; in 2-D two rows of two, or three of three.",
        "[[\"1 + 1e-3*cos(pi*x)\", 0, 0], [0, 1, 0], [0, 0, 1]]"),
    choice("initial.internal", "\"virgin\"", "", menus::internals,
           "Branches start at C_v = G_v = I (virgin) or at equilibrium with F (relaxed).",
           "\"relaxed\""),

    key("manufactured.displacement", vector_field, "m", "", "required in its section", any,
        "Displacement u(X, t) of the motion x = X + u, smooth: + - * / ^, parameters, "
        "functions of type expression, and sin, cos, tan, their inverses, sinh, cosh, tanh, their "
        "inverses, exp, log, sqrt.",
        "[\"0.1*sin(3*t)*sin(pi*x)*cos(pi*y)\", \"0\", \"0\"]"),

    key("boundary.group", groups, "-", "", required, any, "Mesh group, or a list of them.",
        "[\"x_min\", \"y_min\"]"),
    choice("boundary.type", "", required, menus::boundaries,
           "traction (dead, per undeformed area), pressure (follows the surface), fixed, "
           "velocity, symmetry (normal velocity zero, tangentially free), skew-symmetry "
           "(tangential velocity zero, normally free), rigid-wall (frictionless contact with a fixed "
           "rigid plane in space, which the group may touch and leave).", "\"traction\""),
    key("boundary.point", KeyType::vector, "m", "", "with rigid-wall", any,
        "A point of the rigid plane.", "[0, 0, -4e-3]"),
    key("boundary.normal", KeyType::vector, "-", "", "with rigid-wall", any,
        "Normal of the rigid plane, towards the body; any length but 0.", "[0, 0, 1]"),
    key("boundary.value", vector_field, "Pa, m/s", "",
        "with traction, velocity; pressure: a scalar", any,
        "Traction or velocity vector, or pressure; \"manufactured\": traction or velocity of the "
        "motion of [manufactured].",
        "[0, 0, \"-5e4*sin(t)\"]"),

    key("load.body_force", vector_field, "N/m^3", "[0, 0, 0]", "", any,
        "Force per undeformed volume.", "[0, 0, \"-9.81*rho\"]"),

    key("time.end", number, "s", "", required, above(0), "Final time; the run starts at t = 0.",
        "\"1.25*2*pi/omega\""),
    choice("time.integrator", "\"ssp-rk3\"", "", menus::integrators,
           "Time integrator. ssp-rk3: third order, branches by GEXP; leapfrog: one evaluation a step, second "
           "order but for its dissipation, which lags half a step; ssp-rk43: four stages of third order, the "
           "cheapest with slope limiters and strong dissipation.",
           "\"leapfrog\""),
    key("time.cfl", number, "-", "", "optional; found from the graph and the integrator",
        Range{0, 10, false, true}, "Time step as a fraction of the bound of the graph.", "0.5"),
    choice("time.speeds", "\"exact\"", "", menus::speeds,
           "Wave speeds of the time step: of the current state pair by pair, the largest of the "
           "current state for all pairs (a little smaller step), or of the undeformed body (a stiffening "
           "body can then exceed the stable step).",
           "\"bound\""),
    key("time.max_steps", integer, "-", "0", "", at_least(0),
        "The run stops after so many steps; 0 sets no limit.", "1000"),

    key("output.frames", integer, "-", "10", "", between(1, 1e6),
        "Instants of output after t = 0, evenly spaced, the last at the end.", "50"),
    key("output.fields", flag, "-", "true", "", any, "Write the fields, not only the history.",
        "false"),

    key("probe.name", text, "-", "", required, any,
        "What the quantity is called; its column is \"name [unit]\".", "\"tip deflection\""),
    key("probe.unit", text, "-", "", required, any, "Unit of the quantity; \"-\" for none.",
        "\"m\""),
    choice("probe.kind", "\"point\"", "", menus::probe_kinds,
           "point (value at the node nearest to `at`), mean (over the area of the groups, or over "
           "the volume of the body), integral (the same, not divided), least, greatest (over the "
           "nodes of the groups or of the body), reaction (force that supports and walls exert on "
           "the nodes of the groups).", "\"mean\""),
    key("probe.quantity", scalar_field, "that of probe.unit", "", "required but with reaction", any,
        "Expression of the fields at a node: displacement ux, uy, uz, velocity vx, vy, vz, "
        "deformation gradient Fxx ... Fzz, first Piola-Kirchhoff stress Pxx ... Pzz, Cauchy stress "
        "sxx, syy, szz, sxy, syz, sxz, von Mises stress mises, pressure p, Jacobian J; of the "
        "reference position x, y, z, the time t and parameters.", "\"ux\""),
    key("probe.at", KeyType::vector, "m", "", "with point", any,
        "Reference position in the body; the nearest node is taken.",
        "[0, 0, 6]"),
    key("probe.group", groups, "-", "", "with reaction; optional with mean ... greatest", any,
        "Mesh group, or a list of them.", "\"x_max\""),
    key("probe.direction", KeyType::vector, "-", "", "with reaction", any,
        "The component of the reaction along this vector; any length but 0.", "[0, 0, 1]"),
    key("probe.every_step", flag, "-", "false", "", any,
        "Also evaluate it after every step, for steps.csv.", "true"),
    key("probe.oscillation", flag, "-", "false", "", any,
        "Read period, logarithmic decrement and mean of an oscillation from its values.",
        "true"),

    key("reference.probe", text, "-", "", required, any, "Name of the probe that they belong to.",
        "\"tip deflection\""),
    key("reference.value", number, "that of the probe", "", "or reference.file", any,
        "One value.", "14.735"),
    key("reference.time", number, "s", "", "with value", at_least(0), "Its time.", "0.08"),
    key("reference.file", path, "-", "", "or reference.value", any,
        "CSV file beside the case file: a line of names, then lines of time (s) and value (in the "
        "unit of the probe).", "\"reference.csv\""),
    key("reference.source", text, "-", "", required, any,
        "Where they are from, as the report shall name it.",
        "\"solids4foam/solid-benchmarks\""),

    choice("scheme.unknowns", "\"FHJ\"", "", menus::unknowns,
           "Strain measures with evolution equations of their own; the others follow from F.",
           "\"F\""),
    choice("scheme.reconstruction", "\"linear\"", "", menus::reconstructions,
           "Reconstruction of the states on both sides of a pair.", "\"none\""),
    choice("scheme.limiter", "\"none\"", "", menus::limiters,
           "Limiter of the linear reconstruction. At fronts: venkatakrishnan, with "
           "scheme.face_correction = \"1/6\".",
           "\"venkatakrishnan\""),
    choice("scheme.impedance", "\"isotropic\"", "", menus::impedances,
           "Impedance of the dissipation: of the two wave speeds, or the exact matrix.",
           "\"exact\""),
    key("scheme.dissipation", number, "-", "1", "", at_least(0), "Factor of the dissipation D_ab.",
        "0"),
    key("scheme.face_correction", number, "-", "0", "", between(0, 0.25),
        "Factor kappa_f of the face correction with its adjoint: 0 none, 1/6 fourth-order first "
        "derivatives on a lattice, 1/8 exact face values of quadratics.",
        "\"1/6\""),
    choice("scheme.precision", "\"double\"", "", menus::precisions,
           "Precision of what the sweeps keep. mixed: pseudo-areas C_ab in single, half the memory of "
           "irregular nodes, 1e-7 of error. single: the state and the sums over pairs too; half the "
           "memory, some 1e-5 of error relative to the largest speed.",
           "\"single\""),
    key("scheme.angular_momentum_projection", flag, "-", "false", "", any,
        "Correct the forces so that angular momentum is conserved.", "true"),
    key("scheme.energy_budget", flag, "-", "true", "", any,
        "Sum up stored, dissipated and external work.", "false"),

    choice("sph.kernel", "\"cubic-spline\"", "", menus::kernels, "Smoothing kernel.",
           "\"wendland-c2\""),
    key("sph.kappa", number, "-", "1.2", "", between(0.5, 4),
        "Smoothing length over particle spacing: h_a = kappa Omega_a^(1/d). 1.2 suits any nodes; "
        "0.75, one spacing and its diagonals, is cheaper and errs less on regular ones.",
        "0.75"),
    key("sph.closure", flag, "-", "true", "", any,
        "Repair of the boundary so that the pseudo-areas close (sum C_ab = -gamma_a).", "false"),

    choice("fvm.stencil", "\"edge\"", "", menus::stencils,
           "Pair areas by nodal quadrature (edge), by 2 int N_a grad N_b dV (integral), or from operators "
           "that sum by parts along the lines of nodes (sbp), on boxes of hexahedra or quadrilaterals.",
           "\"sbp\""),
    key("fvm.order", integer, "-", "4", "", between(2, 6),
        "With stencil = \"sbp\", order of the derivatives inside: 2 (the edge stencil), 4 or 6; half of it "
        "at boundaries. On lines of fewer than 8 (4) or 12 nodes (6) it falls to the next. 6 takes "
        "scheme.limiter = \"sign-preserving\" or none of the reconstruction.",
        "6"),

    key("exact.displacement", vector_field, "m", "", "optional", any, "Exact displacement.",
        "[\"q*sin(pi*y/2)\", 0, 0]"),
    key("exact.velocity", vector_field, "m/s", "", "optional", any, "Exact velocity.",
        "[\"q_dot*sin(pi*y/2)\", 0, 0]"),
    key("exact.deformation_gradient", tensor_field, "-", "", "optional", any,
        "Exact F, by rows; in 2-D two rows of two, or three of three.",
        "[[1, \"q*pi/2*cos(pi*y/2)\", 0], [0, 1, 0], [0, 0, 1]]"),
    key("exact.stress", tensor_field, "Pa", "", "optional", any,
        "Exact first Piola-Kirchhoff stress, three rows of three (P_33 in 2-D too).",
        "[[0, \"mu*q*pi/2*cos(pi*y/2)\", 0], [\"mu*q*pi/2*cos(pi*y/2)\", 0, 0], [0, 0, 0]]"),

    key("record.file", path, "-", "", "in a copy", any,
        "The case file that this is a copy of: it names the case, and relative paths start there.",
        "\"/home/me/cube/case.toml\""),
    key("record.overrides", texts, "-", "[]", "", any,
        "What the command line had set (--set), read before any --set of now.",
        "[\"time.end=0.1\", \"sph.kappa=0.75\"]"),
};
// clang-format on

}  // namespace

std::span<const Key> keys() {
  return key_table;
}

std::span<const Section> sections() {
  return section_table;
}

}  // namespace diptych::cases
