#include "benchmarks/run/backends.hpp"

#include "benchmarks/run/strong_pressure.hpp"
#include "common/base/error.hpp"
#include "common/run/solver.hpp"
#include "common/scheme/option_menus.hpp"
#include "common/scheme/volumes/bulk_volumes.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/cell_widths.hpp"
#include "meshes/structured_block.hpp"
#include "sph/sph_graph.hpp"

#include <fmt/format.h>

namespace diptych::harness {

namespace {

/// Why a case that leaves the choice ("auto") has operators of second order, whatever the mesh;
/// empty: it may have others. The face correction is for derivatives of second order; volumes of
/// cells have boundary areas of their own.
std::string second_order_because(const cases::Case& setup, const std::string& method) {
  const bool is_sph = method == "sph";
  if ((is_sph ? setup.sph.gradient : setup.fvm.stencil) != "auto") return "";
  if (setup.scheme.face_correction != 0) return "the face correction is for it";
  return setup.scheme.volumes == "cells" ? "volumes of cells carry the pressure" : "";
}

scheme::Operators sph_operators(const meshes::Mesh& mesh,
                                const cases::Case& setup,
                                const std::string& strong_pressure) {
  scheme::Operators operators = sph::operators_on(
      mesh, {setup.sph.kernel, setup.sph.kappa, setup.sph.closure, setup.sph.gradient,
             second_order_because(setup, "sph"), strong_pressure});
  // its lines have slopes, with which the sign is known
  if (!operators.graph.slopes.empty() && run::wants_line_slopes(setup)) operators.notices.clear();
  return operators;
}

/// From nu = 0.495 on curved blocks lock on their lines (fvm::Options).
bool is_hardly_compressible(const cases::MaterialCase& material) {
  constexpr double least_ratio = 99 * (1 - 1e-9);
  return material.lame >= least_ratio * material.shear_modulus;
}

scheme::Operators fvm_operators(const meshes::Mesh& mesh,
                                const cases::Case& setup,
                                const std::string& strong_pressure) {
  return fvm::operators_on(
      mesh,
      {setup.fvm.stencil, setup.fvm.order, second_order_because(setup, "fvm"), strong_pressure,
       takes_symmetric_jumps(setup.scheme), is_hardly_compressible(setup.material)});
}

/// Of operators that do not commute and have no volumes of cells, in bodies under strong pressure
/// (notes 10.1).
constexpr const char* pressure_notice =
    "nodes carry the bulk pressure, which can be strong here; above some shear moduli it turns "
    "cells inside out (the run is then stopped), which scheme.volumes = \"cells\", or \"lines\" "
    "with SPH on boxes, bears where the mesh and the operators have them (notes 3.9)";

/// Of those that sum by parts: jumps that lose their sign were found to harm bodies under such
/// pressure alone.
constexpr const char* sign_notice =
    "sbp: on these nodes the sign of the numerical dissipation is known with scheme.reconstruction "
    "= \"symmetric\" or scheme.limiter = \"sign-preserving\" alone; with others a body under "
    "strong "
    "pressure may come apart (notes 4.5)";

constexpr const char* hourglass_notice =
    "scheme.hourglass has no effect: it is for operators that sum by parts off boxes and curved "
    "blocks (notes 3.12)";

constexpr const char* cell_shear_notice =
    "scheme.cell_shear has no effect: volumes of cells do not carry the pressure here "
    "(scheme.volumes = \"cells\" asks for them)";

/// Part of an area by which forces of a constant stress may be out of balance.
constexpr double closed = 1e-9;

/// Few neighbours whose rows are exact for linear fields leave nothing to close them by.
void note_open_rows(const scheme::PairGraph& graph, std::vector<std::string>& notices) {
  const double gap = scheme::quality(graph).closure;
  if (gap <= closed) return;
  notices.push_back(fmt::format(
      "forces of a constant stress are out of balance by up to {:.2g} of an area: nodes of this "
      "mesh have too few neighbours to close them; take more cells across the body",
      gap));
}

/// Whether jumps are those of linear reconstructions without the adjoint of their slopes.
bool leaves_jumps(const cases::SchemeCase& scheme) {
  return scheme.limiter == "none" && scheme.reconstruction != "none" &&
         !takes_symmetric_jumps(scheme);
}

/// Whether volumes of cells, and their part of the shear, are taken where little presses: off
/// boxes, but with the face correction, which nodes have alone. Columns that bend err alike with
/// both on cells 1.8 times as long as wide (notes 3.11).
bool takes_cells(const scheme::Operators& operators,
                 const meshes::Mesh& mesh,
                 const cases::Case& setup) {
  return operators.errs_less_with_cells && setup.scheme.face_correction == 0 &&
         !meshes::is_undistorted_block(mesh) && meshes::has_short_cells(mesh);
}

/// In the precision of the case, with what its other options make of them.
scheme::Operators finished(scheme::Operators operators,
                           const meshes::Mesh& mesh,
                           const cases::Case& setup,
                           const std::string& strong_pressure,
                           bool asks_for_closure) {
  scheme::PairGraph& graph = operators.graph;
  const bool presses = !strong_pressure.empty();
  const bool may_press = presses || is_nearly_incompressible(setup.material);
  if (setup.scheme.volumes == "auto" && !presses) {
    // they err as nodes do in smooth motion and cost a sixth more, or come apart in tension
    if (!holds_with_lines(setup.material)) graph.lines = {};
    if (!may_press && !takes_cells(operators, mesh, setup)) graph.cells = {};
  }
  if (operators.loses_sign && presses && leaves_jumps(setup.scheme))
    operators.notices.emplace_back(sign_notice);
  if (setup.scheme.volumes == "auto" && may_press && !graph.commutes && graph.cells.empty() &&
      graph.lines.empty() && can_press(setup, mesh))
    operators.notices.emplace_back(pressure_notice);
  if (setup.scheme.hourglass != cases::SchemeCase().hourglass && setup.scheme.hourglass != 0 &&
      graph.edges.empty())
    operators.notices.emplace_back(hourglass_notice);
  if (setup.scheme.cell_shear != cases::SchemeCase().cell_shear && setup.scheme.volumes == "auto" &&
      scheme::safe_volumes(graph) != scheme::Volumes::cells)
    operators.notices.emplace_back(cell_shear_notice);
  if (asks_for_closure) note_open_rows(graph, operators.notices);
  set_precision(graph, scheme::precision_menu().at(setup.scheme.precision));
  return operators;
}

/// What SPH that sums by parts does not go with.
void check_sph(const cases::Case& setup) {
  if (setup.sph.gradient != "sbp" || setup.scheme.face_correction == 0) return;
  throw base::InputError(fmt::format(
      "{}: scheme.face_correction = {:.4g} corrects derivatives of second order and would spoil "
      "those of sph.gradient = \"sbp\"; set it to 0",
      setup.file, setup.scheme.face_correction));
}

/// What finite volumes that sum by parts do not go with.
void check_fvm(const cases::Case& setup) {
  const std::string& stencil = setup.fvm.stencil;
  if (!second_order_because(setup, "fvm").empty()) return;
  if ((stencil != "sbp" && stencil != "auto") || setup.fvm.order == 2) return;
  const cases::SchemeCase& scheme = setup.scheme;
  if (scheme.face_correction != 0) {
    throw base::InputError(fmt::format(
        "{}: scheme.face_correction = {:.4g} corrects derivatives of second order and would spoil "
        "those of fvm.stencil = \"sbp\" with fvm.order = {}; set it to 0",
        setup.file, scheme.face_correction, setup.fvm.order));
  }
  // In its boundary rows the jumps that are left of linear reconstructions have, in the mean, the
  // sign opposite to the plain ones (sbp_operator.hpp).
  if (setup.fvm.order == 6 && scheme.dissipation > 0 && scheme.reconstruction == "linear" &&
      scheme.limiter == "none") {
    throw base::InputError(fmt::format(
        "{}: fvm.stencil = \"sbp\" with fvm.order = 6 gains energy at boundaries from D_ab with "
        "unlimited linear reconstruction; use scheme.reconstruction = \"quartic\" or fvm.order = 4",
        setup.file));
  }
}

}  // namespace

bool takes_symmetric_jumps(const cases::SchemeCase& scheme) {
  if (scheme.reconstruction != "auto") return scheme.reconstruction == "symmetric";
  return scheme.limiter == "none" && scheme.face_correction == 0;
}

const base::Registry<GraphMaker>& method_menu() {
  static const auto menu =
      base::Registry<GraphMaker>("method")
          .add("sph",
               [](const meshes::Mesh& mesh, const cases::Case& setup) {
                 check_sph(setup);
                 const std::string strong = strong_pressure_because(setup, "sph", mesh);
                 return finished(sph_operators(mesh, setup, strong), mesh, setup, strong,
                                 setup.sph.closure);
               })
          .add("fvm", [](const meshes::Mesh& mesh, const cases::Case& setup) {
            check_fvm(setup);
            const std::string strong = strong_pressure_because(setup, "fvm", mesh);
            return finished(fvm_operators(mesh, setup, strong), mesh, setup, strong, true);
          });
  return menu;
}

}  // namespace diptych::harness
