#include "common/base/error.hpp"
#include "common/cases/sections/sections.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>

namespace diptych::cases {

namespace {

/// Names and units make up the headers of columns, "name [unit]".
std::string label(const SectionValues& section, const char* key, const char* forbidden) {
  const std::string text = section.text(key);
  if (!text.empty() && text.find_first_of(forbidden) == std::string::npos) return text;
  section.fail(key, text.empty() ? std::string("is empty; give it a text for the column's header")
                                 : fmt::format("= '{}' holds one of {} and cannot be part of the "
                                               "header of a column",
                                               text, forbidden));
}

/// What tables, bounds and columns call what every run has: a probe of such a name would stand for
/// it, or it for the probe. (A test holds them against history.csv, bounds and tables.)
constexpr std::array<std::string_view, 35> taken_names{
    "all",
    "time",
    "step",
    "dt",
    "kinetic energy",
    "strain energy",
    "viscous dissipation",
    "numerical dissipation",
    "external work",
    "projection work",
    "relative energy residual",
    "linear momentum x",
    "linear momentum y",
    "linear momentum z",
    "angular momentum x",
    "angular momentum y",
    "angular momentum z",
    "min jacobian",
    "involution H",
    "involution J",
    "least cell J",
    "energy residual",
    "inverted cells",
    "least J",
    "kinetic growth",
    "numerical share",
    "linear momentum drift",
    "angular momentum drift",
    "steps",
    "seconds",
    "nodes",
    "pairs",
    "end time",
    "fall of viscous dissipation",
    "fall of numerical dissipation",
};

/// What stands behind the name of a probe where tables and bounds mean a number of it.
constexpr std::array<std::string_view, 5> parts_of_probes{", final", ", least", ", greatest",
                                                          ", period", ", amplitude"};

/// The probe that a name would be a part of, "tip" of "tip, final"; empty where it has no such end.
std::string_view whole_of(std::string_view name) {
  for (const std::string_view part : parts_of_probes) {
    if (name.ends_with(part)) return name.substr(0, name.size() - part.size());
  }
  return {};
}

void check_name(const SectionValues& section, const std::string& name) {
  if (std::find(taken_names.begin(), taken_names.end(), name) == taken_names.end()) return;
  section.fail("name",
               fmt::format("= '{}' is what every run has under this name, in its tables and "
                           "columns; rename the probe",
                           name));
}

/// @throws base::InputError where a name could be meant as that of one or as a part of another
void check_parts(const std::vector<ProbeCase>& probes) {
  for (const ProbeCase& probe : probes) {
    for (const ProbeCase& other : probes) {
      if (whole_of(probe.name) != other.name) continue;
      throw base::InputError(
          fmt::format("{}'{}' is what tables and bounds call a part of the probe "
                      "'{}' (line {}); rename one",
                      functions::prefix(probe.where), probe.name, other.name, other.where.line));
    }
  }
}

SectionKeys<ProbeCase> probe_keys() {
  return SectionKeys<ProbeCase>("probe")
      .key("name", KeyType::text,
           {"-", any, "What the quantity is called; its column is \"name [unit]\".",
            "\"tip deflection\"", "required"})
      .key("unit", KeyType::text,
           {"-", any, "Unit of the quantity; \"-\" for none.", "\"m\"", "required"})
      .key(
          "kind", &ProbeCase::kind,
          one_of({"point", "mean", "integral", "least", "greatest", "checkerboard", "reaction"},
                 "point (value at `at`, interpolated between nodes), mean (over the area of the "
                 "groups, "
                 "or over the volume of the body), integral (the same, not divided), least, "
                 "greatest (over the nodes of the groups or of the body), checkerboard (what "
                 "linear fits to the neighbours of each node leave of it, over what it differs "
                 "from its mean, both as norms over the body or region: 1 to 1.5 where it "
                 "alternates from node to node, falling with the square of the spacing where it is "
                 "smooth), reaction (force that "
                 "supports and walls exert on the nodes of the groups at that instant; the impulse "
                 "with which a wall catches a node within a step is not in it).",
                 "\"mean\""))
      .key("quantity", KeyType::scalar_field,
           {"that of probe.unit", any,
            "Expression of the fields at a node: displacement ux, uy, uz, velocity vx, vy, vz, "
            "deformation gradient Fxx ... Fzz, first Piola-Kirchhoff stress Pxx ... Pzz, Cauchy "
            "stress sxx, syy, szz, sxy, syz, sxz, von Mises stress mises, pressure p, Jacobian J; "
            "of the reference position x, y, z, the time t and parameters.",
            "\"ux\"", "required but with reaction"})
      .key("at", KeyType::vector,
           {"m", any,
            "Reference position in the body, in a cell of the mesh or outside it by no more than a "
            "tenth of its width; between nodes the quantity is interpolated (quadratics).",
            "[0, 0, 6]", "with point"})
      .key("group", KeyType::groups,
           {"-", any, "Mesh group, or a list of them.", "\"x_max\"",
            "with reaction; optional with mean ... greatest"})
      .key("region", KeyType::scalar_field,
           {"-", any,
            "Only the nodes in whose reference position this expression of x, y, z and parameters "
            "is not 0, each with its whole volume or area.",
            "\"z >= 1 && x < 0.5\"", "optional with mean ... checkerboard"})
      .key("direction", KeyType::vector,
           {"-", any, "The component of the reaction along this vector; any length but 0.",
            "[0, 0, 1]", "with reaction"})
      .key(
          "every_step", &ProbeCase::every_step,
          {"-", any,
           "Also evaluate it after every step, for steps.csv; so is one with oscillation.", "true"})
      .key("oscillation", &ProbeCase::oscillation,
           {"-", any,
            "Read period, logarithmic decrement and mean of an oscillation from its values after "
            "every "
            "step.",
            "true"});
}

/// What the kind takes; the rest must not be there.
void read_quantity(const SectionValues& section,
                   functions::Vocabulary vocabulary,
                   ProbeCase& probe) {
  probe.where = section.where();
  probe.every_step |= probe.oscillation;  // rows may be too far apart to show the period
  probe.name = label(section, "name", "[]/");
  check_name(section, probe.name);
  probe.unit = label(section, "unit", "[]");
  const auto refuse = [&](const char* name) {
    section.refuse(name, fmt::format("has no effect on kind = \"{}\"; remove it", probe.kind));
  };
  if (probe.kind == "reaction" || probe.kind == "point") {
    refuse("region");
  } else if (section.has("region")) {
    probe.region = section.scalar_field("region", vocabulary);  // which has no fields yet
    if (probe.region->depends_on_time())
      section.fail("region", fmt::format("= '{}' depends on the time; write it in x, y, z and "
                                         "parameters",
                                         probe.region->text()));
  }
  if (probe.kind == "reaction") {
    refuse("quantity");
    probe.direction = section.direction("direction");
  } else {
    refuse("direction");
    probe.fields = std::make_shared<ProbeFields>();
    probe.fields->check_names(vocabulary, probe.where);
    vocabulary.time_functions.push_back(probe.fields);
    probe.quantity = section.scalar_field("quantity", vocabulary);
  }
  if (probe.kind == "point") {
    refuse("group");
    probe.at = section.vector("at");
  } else {
    refuse("at");
    if (probe.kind == "checkerboard") refuse("group");
    if (probe.kind == "reaction" || section.has("group")) probe.groups = section.groups("group");
  }
}

std::vector<ProbeCase> read_probes(const Reading& reading, const SectionKeys<ProbeCase>& keys) {
  std::vector<ProbeCase> probes;
  for (const SectionValues& entry : reading.entries("probe")) {
    ProbeCase probe = keys.read(entry);
    read_quantity(entry, reading.vocabulary, probe);
    for (const ProbeCase& other : probes) {
      if (other.name != probe.name) continue;
      throw base::InputError(fmt::format("{}a probe is already called '{}' (line {}); rename one",
                                         functions::prefix(probe.where), probe.name,
                                         other.where.line));
    }
    probes.push_back(std::move(probe));
  }
  check_parts(probes);
  return probes;
}

}  // namespace

SectionEntry probe_section() {
  const auto keys = probe_keys();
  return {{"probe", true,
           "A quantity of interest: a column of history.csv, an entry of summary.json, a value in "
           "each field file."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) { setup.probes = read_probes(reading, keys); }};
}

}  // namespace diptych::cases
