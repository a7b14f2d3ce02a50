#include "benchmarks/run/backends.hpp"

#include "common/base/error.hpp"
#include "common/scheme/option_menus.hpp"
#include "fvm/fvm_graph.hpp"
#include "sph/sph_graph.hpp"

#include <fmt/format.h>

namespace diptych::harness {

namespace {

scheme::PairGraph in_precision(scheme::PairGraph graph, const std::string& precision) {
  set_precision(graph, scheme::precision_menu().at(precision));
  return graph;
}

sph::Options sph_options(const cases::Case& setup) {
  return {setup.sph.kernel, setup.sph.kappa, setup.sph.closure, setup.sph.gradient};
}

fvm::Options fvm_options(const cases::Case& setup) {
  return {setup.fvm.stencil, setup.fvm.order};
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
  if (setup.fvm.stencil != "sbp" || setup.fvm.order == 2) return;
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
        "unlimited reconstruction; use fvm.order = 4, or scheme.limiter = \"sign-preserving\"",
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
  if (method == "sph") {
    const sph::Operators operators = sph::operators_of(mesh, sph_options(setup));
    return {operators.text, operators.notices};
  }
  const fvm::Operators operators = fvm::operators_of(mesh, fvm_options(setup));
  return {operators.text, operators.lost};
}

}  // namespace diptych::harness
