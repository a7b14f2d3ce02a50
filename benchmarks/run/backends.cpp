#include "benchmarks/run/backends.hpp"

#include "common/base/error.hpp"
#include "common/run/solver.hpp"
#include "common/scheme/option_menus.hpp"
#include "fvm/fvm_graph.hpp"
#include "meshes/structured_block.hpp"
#include "sph/sph_graph.hpp"

#include <fmt/format.h>

namespace diptych::harness {

namespace {

scheme::PairGraph in_precision(scheme::PairGraph graph, const std::string& precision) {
  set_precision(graph, scheme::precision_menu().at(precision));
  return graph;
}

/// Why a case that leaves the choice ("auto") has operators of second order, whatever the mesh;
/// empty: it may have others. The face correction is for derivatives of second order; volumes of
/// cells have boundary areas of their own.
std::string second_order_because(const cases::Case& setup, const std::string& method) {
  const bool is_sph = method == "sph";
  if ((is_sph ? setup.sph.gradient : setup.fvm.stencil) != "auto") return "";
  if (setup.scheme.face_correction != 0) return "the face correction is for it";
  return setup.scheme.volumes == "cells" ? "volumes of cells carry the pressure" : "";
}

sph::Options sph_options(const cases::Case& setup) {
  const bool is_corrected = !second_order_because(setup, "sph").empty();
  return {setup.sph.kernel, setup.sph.kappa, setup.sph.closure,
          is_corrected ? "corrected" : setup.sph.gradient};
}

fvm::Options fvm_options(const cases::Case& setup) {
  const bool is_edge = !second_order_because(setup, "fvm").empty();
  return {is_edge ? "edge" : setup.fvm.stencil, setup.fvm.order};
}

/// Of operators that sum by parts but do not commute, in bodies whose pressure volumes of cells
/// would have to carry (notes 10.1).
constexpr const char* pressure_notice =
    "sbp: nodes carry the bulk pressure of this nearly incompressible material; above some shear "
    "moduli it turns cells inside out (the run is then stopped); the default operators bear it "
    "(notes 10.1)";

/// Where the choice was left: operators that sum by parts take long to set up on meshes that are no
/// boxes, and refuse many.
std::vector<std::string> advice(const cases::Case& setup,
                                const std::string& text,
                                const std::string& key) {
  if (run::wants_safe_volumes(setup)) return {};
  return {
      fmt::format("{}; {} = \"sbp\" takes longer to set up and errs several times less on a "
                  "body with plane sides (benchmarks/DEFAULTS.md)",
                  text, key)};
}

GraphDescription description_of(const cases::Case& setup,
                                const std::string& text,
                                std::vector<std::string> notices,
                                bool is_safe) {
  const bool sums_by_parts = text.starts_with("sbp");
  if (sums_by_parts && !is_safe && run::wants_safe_volumes(setup))
    notices.push_back(pressure_notice);
  return {text, std::move(notices)};
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
  const std::string stencil = fvm_options(setup).stencil;
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

const base::Registry<GraphMaker>& method_menu() {
  static const auto menu =
      base::Registry<GraphMaker>("method")
          .add("sph",
               [](const meshes::Mesh& mesh, const cases::Case& setup) {
                 check_sph(setup);
                 return in_precision(sph::build_graph(mesh, sph_options(setup)),
                                     setup.scheme.precision);
               })
          .add("fvm", [](const meshes::Mesh& mesh, const cases::Case& setup) {
            check_fvm(setup);
            return in_precision(fvm::build_graph(mesh, fvm_options(setup)), setup.scheme.precision);
          });
  return menu;
}

GraphDescription graph_description(const std::string& method,
                                   const meshes::Mesh& mesh,
                                   const cases::Case& setup) {
  if (const std::string because = second_order_because(setup, method); !because.empty()) {
    const char* name = method == "sph" ? "corrected gradient" : "edge stencil";
    return {fmt::format("{}: {}", name, because), {}};
  }
  const bool is_block = meshes::is_undistorted_block(mesh);
  if (method == "sph") {
    sph::Operators operators = sph::operators_of(mesh, sph_options(setup));
    if (is_block && run::wants_line_slopes(setup)) operators.notices.clear();
    if (operators.may_sum_by_parts)
      operators.notices = advice(setup, operators.text, "sph.gradient");
    return description_of(setup, operators.text, operators.notices, is_block);
  }
  fvm::Operators operators = fvm::operators_of(mesh, fvm_options(setup));
  if (operators.may_sum_by_parts) operators.lost = advice(setup, operators.text, "fvm.stencil");
  return description_of(setup, operators.text, operators.lost, is_block);
}

}  // namespace diptych::harness
