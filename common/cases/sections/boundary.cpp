#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/sections/sections.hpp"
#include "common/scheme/boundary/boundary_condition.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace diptych::cases {

namespace {

using Takes = scheme::BoundaryKind::Takes;
using Acts = scheme::BoundaryKind::Acts;

const scheme::BoundaryKind& kind_of(const BoundaryCase& boundary) {
  return scheme::boundary_menu().at(boundary.type);
}

/// "fixed, rigid-wall (...)": the names of those that take something, or of all with their notes.
std::string kinds_that_take(Takes what) {
  std::vector<std::string> names;
  for (const std::string& name : scheme::boundary_menu().names()) {
    if (scheme::boundary_menu().at(name).takes == what) names.push_back(name);
  }
  return base::joined(names);
}
std::string kinds_with_notes() {
  std::vector<std::string> names;
  for (const std::string& name : scheme::boundary_menu().names()) {
    const std::string& note = scheme::boundary_menu().at(name).note;
    names.push_back(note.empty() ? name : fmt::format("{} ({})", name, note));
  }
  return base::joined(names) + ".";
}

SectionKeys<BoundaryCase> boundary_keys() {
  return SectionKeys<BoundaryCase>("boundary")
      .key("group", &BoundaryCase::groups,
           {"-", any, "Mesh group, or a list of them.", "[\"x_min\", \"y_min\"]", "required"})
      .key("type", &BoundaryCase::type,
           one_of(scheme::boundary_menu().names(), kinds_with_notes(), "\"traction\"", "required"))
      .key("point", KeyType::vector,
           {"m", any, "A point of the rigid plane; the body begins before it.", "[0, 0, -4e-3]",
            "with " + kinds_that_take(Takes::plane)})
      .key("normal", KeyType::vector,
           {"-", any, "Normal of the rigid plane, towards the body; any length but 0.", "[0, 0, 1]",
            "with " + kinds_that_take(Takes::plane)})
      .key("value", KeyType::vector_field,
           {"Pa, m/s", any,
            "Traction or velocity vector, or pressure; \"manufactured\": traction or velocity of "
            "the motion of [manufactured].",
            "[0, 0, \"-5e4*sin(t)\"]",
            fmt::format("with {}; {}: a scalar", kinds_that_take(Takes::vector),
                        kinds_that_take(Takes::scalar))});
}

/// What the type takes; the rest must not be there.
void read_values(const SectionValues& section, bool has_motion, BoundaryCase& boundary) {
  const Takes takes = kind_of(boundary).takes;
  if (takes == Takes::scalar) {
    if (!section.has("value")) section.fail("value", "is missing; write value = \"5e4*sin(t)\"");
    boundary.pressure = section.scalar_field("value");
  } else if (takes == Takes::vector && section.is_word("value", "manufactured")) {
    if (!has_motion)
      section.fail("value", "= \"manufactured\" needs a motion; give it in [manufactured]");
    boundary.manufactured = true;
  } else if (takes == Takes::vector) {
    boundary.value = section.vector_field("value");
  } else {
    section.refuse("value",
                   fmt::format("has no effect on type = \"{}\"; remove it", boundary.type));
  }
  if (takes == Takes::plane) {
    boundary.point = section.vector("point");
    boundary.normal = section.direction("normal");
    return;
  }
  for (const char* name : {"point", "normal"})
    section.refuse(name, fmt::format("has no effect on type = \"{}\"; it is for {}", boundary.type,
                                     kinds_that_take(Takes::plane)));
}

/// Whether both may act on one group: two different loads, or a load and a symmetry; a wall with
/// anything but itself and what holds all. (Which walls may share nodes is seen at the nodes.)
bool agree(const BoundaryCase& a, const BoundaryCase& b) {
  const Acts first = kind_of(a).acts, second = kind_of(b).acts;
  if (first == Acts::touch && second == Acts::touch)
    return a.point != b.point || a.normal != b.normal;
  if (first == Acts::hold || second == Acts::hold) return false;
  if (first == Acts::load && second == Acts::load) return a.type != b.type;
  return first != second;
}

/// No two entries may prescribe different things on one group.
void check_contradictions(const std::vector<BoundaryCase>& boundaries) {
  for (size_t i = 0; i < boundaries.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (const std::string& group : boundaries[i].groups) {
        const BoundaryCase &a = boundaries[i], &b = boundaries[j];
        const bool shared = std::find(b.groups.begin(), b.groups.end(), group) != b.groups.end();
        if (!shared || agree(a, b)) continue;
        throw base::InputError(fmt::format(
            "{}boundary '{}' is already of type {} (line {}) and cannot also be of type {}; remove "
            "one",
            functions::prefix(a.where), shown(group), b.type, b.where.line, a.type));
      }
    }
  }
}

}  // namespace

SectionEntry boundary_section() {
  const auto keys = boundary_keys();
  return {{"boundary", true,
           "A boundary condition on groups of the mesh; what no entry names is free."},
          keys.keys(),
          [keys](Reading& reading, Case& setup) {
            for (const SectionValues& entry : reading.entries("boundary")) {
              BoundaryCase boundary = keys.read(entry);
              boundary.where = entry.where();
              read_values(entry, setup.motion != nullptr, boundary);
              setup.boundaries.push_back(std::move(boundary));
            }
            check_contradictions(setup.boundaries);
          }};
}

}  // namespace diptych::cases
