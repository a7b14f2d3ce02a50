#include "benchmarks/run/run_identity.hpp"

#include "common/cases/reader.hpp"
#include "common/cases/settings.hpp"
#include "common/io/checkpoint_file.hpp"
#include "common/run/state_hash.hpp"

#include <fmt/format.h>

namespace diptych::harness {

void RunIdentity::archive(algebra::Archive& archive) {
  archive.text("identity/method", method);
  archive.integer("identity/level", level);
  archive.text("identity/settings", settings);
  archive.text("identity/volumes", volumes);
  archive.text("identity/nodes", nodes);
  archive.text("identity/groups", groups);
  archive.text("identity/program", program);
  archive.text("identity/version", version);
  archive.text("identity/instruction set", instruction_set);
}

RunIdentity identity_of(const cases::Case& setup,
                        const scheme::PairGraph& graph,
                        const io::RunSummary& summary) {
  RunIdentity identity;
  identity.method = summary.method;
  identity.level = summary.level;
  identity.settings = cases::settings_text(cases::lasting_settings(setup));
  identity.volumes = summary.volumes;
  identity.nodes = run::hash_of_nodes(graph);
  identity.groups = run::hash_of_groups(graph);
  identity.program = summary.provenance.program;
  identity.version = summary.provenance.version + " " + summary.provenance.commit;
  identity.instruction_set = summary.provenance.instruction_set;
  return identity;
}

std::string difference_of(const RunIdentity& before, const RunIdentity& now) {
  if (before.method != now.method)
    return fmt::format("is of method {}, the run is of {}", before.method, now.method);
  if (before.level != now.level)
    return fmt::format("is of level {}, the run is of level {}", before.level, now.level);
  const std::string changed = cases::changed_setting(before.settings, now.settings);
  if (!changed.empty()) {
    return "is of another case: " + changed +
           "; only time.end, time.max_steps, time.checkpoint_* and [output] may change";
  }
  if (before.volumes != now.volumes) {
    return fmt::format(
        "is of a run whose pressure {} carry, scheme.volumes = \"auto\" comes to {} now: a load "
        "presses strongly before one time.end and not before the other; begin anew",
        before.volumes, now.volumes);
  }
  if (before.nodes != now.nodes)
    return "is of other nodes: the mesh file, or the gmsh that meshed it, has changed";
  if (before.groups != now.groups)
    return "is of other boundary groups: those of the mesh file, or of the gmsh that meshed it, "
           "have changed";
  return "";
}

std::string doubt_about(const RunIdentity& before, const RunIdentity& now) {
  if (before.program != now.program) {
    return fmt::format(
        "was written by another program ({}, this is {}): the last bits of what "
        "follows may differ",
        before.version, now.version);
  }
  if (before.instruction_set == now.instruction_set) return "";
  return fmt::format(
      "was written on a processor with {}, this one has {}: the last bits of what "
      "follows may differ",
      before.instruction_set, now.instruction_set);
}

RunIdentity identity_in(const std::string& path) {
  io::CheckpointReader reader(path);
  RunIdentity identity;
  identity.archive(reader);
  return identity;
}

}  // namespace diptych::harness
