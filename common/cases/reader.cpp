#include "common/cases/reader.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/bounded_file.hpp"
#include "common/cases/copy.hpp"
#include "common/cases/document.hpp"
#include "common/cases/functions.hpp"
#include "common/cases/keys.hpp"
#include "common/cases/material.hpp"
#include "common/cases/probes.hpp"
#include "common/cases/references.hpp"
#include "common/cases/values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace diptych::cases {

namespace {

namespace fs = std::filesystem;

/// The sections of one document.
class Sections {
 public:
  explicit Sections(const Value& document) : document_(document) {}

  functions::Vocabulary vocabulary;
  int dimension = 3;

  const Value& document() const { return document_; }
  const Value* table(const std::string& name) const {
    const Member* member = document_.find(name);
    return member == nullptr ? nullptr : &member->value;
  }
  SectionValues top() const { return {document_, &document_, "", vocabulary, dimension}; }
  SectionValues section(const std::string& name) const {
    return {document_, table(name), name, vocabulary, dimension};
  }
  /// Entries of the list `list`, which stands at `path`.
  std::vector<SectionValues> entries(const Value* list, const std::string& path) const {
    std::vector<SectionValues> all;
    for (size_t i = 0; list != nullptr && i < list->elements.size(); ++i)
      all.emplace_back(document_, &list->elements[i], fmt::format("{}.{}", path, i), vocabulary,
                       dimension);
    return all;
  }

 private:
  const Value& document_;
};

/// A name that the user gives to a number must be new and fit for expressions.
void check_new_name(const std::string& name,
                    const std::vector<std::string>& taken,
                    const functions::SourcePlace& where) {
  if (!functions::is_name(name)) {
    throw base::InputError(
        fmt::format("{}'{}' is no name; use letters, digits and '_', a letter first",
                    functions::prefix(where), shown(name)));
  }
  const auto& reserved = functions::reserved_names();
  if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) {
    throw base::InputError(
        fmt::format("{}'{}' already has a meaning in expressions; take another name",
                    functions::prefix(where), name));
  }
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    throw base::InputError(
        fmt::format("{}'{}' is defined twice; take another name", functions::prefix(where), name));
  }
}

void read_parameters(Sections& sections) {
  const Value* table = sections.table("parameters");
  if (table == nullptr) return;
  for (const Member& member : table->members) {
    check_new_name(member.name, {}, member.where);
    // The vocabulary holds the parameters above only, so none can use itself or a later one. A
    // table of one: looking each up among all would take their number squared.
    Value one;
    one.where = table->where;
    one.members = {member};
    const SectionValues section(sections.document(), &one, "parameters", sections.vocabulary,
                                sections.dimension);
    const double value = section.number(member.name);
    sections.vocabulary.parameters[member.name] = value;
  }
}

void read_functions(Sections& sections) {
  const Value* table = sections.table("functions");
  if (table == nullptr) return;
  std::vector<std::string> taken;
  for (const auto& [name, value] : sections.vocabulary.parameters)
    taken.push_back(name);
  for (const Member& member : table->members) {
    const SectionValues section(sections.document(), &member.value, "functions." + member.name,
                                sections.vocabulary, sections.dimension);
    check_new_name(member.name, taken, member.where);
    std::shared_ptr<const functions::TimeFunction> function;
    try {
      function = read_function(member.name, section);
    } catch (const base::InputError& error) {
      const std::string message = error.what();
      if (message.rfind("functions.", 0) != 0) throw;
      throw base::InputError(functions::prefix(member.where) + message);
    }
    for (const std::string& name : function->names()) {
      check_new_name(name, taken, member.where);
      taken.push_back(name);
    }
    sections.vocabulary.time_functions.push_back(function);
  }
}

void read_mesh_file(const SectionValues& section, const fs::path& folder, MeshCase& mesh) {
  mesh.generator.clear();
  if (!section.has("element")) {
    section.fail("element",
                 "is missing; with mesh.file it tells whether the case is 2-D (triangle, "
                 "quadrilateral) or 3-D (tetrahedron, hexahedron)");
  }
  for (const char* name : {"lower", "upper", "cells"})
    section.refuse(name, "has no effect with mesh.file; remove one of the two");
  const std::string file = section.text("file");
  const fs::path path = (folder / file).lexically_normal();
  const std::string extension = path.extension().string();
  if (extension != ".msh" && extension != ".geo")
    section.fail("file", fmt::format("= '{}' is neither a .msh nor a .geo file", shown(file)));
  std::error_code ignored;  // a file that cannot be seen is not there
  if (!fs::is_regular_file(path, ignored))
    section.fail("file", fmt::format("= '{}' does not exist: {}", shown(file), path.string()));
  mesh.file = path.string();
  if (extension == ".geo") mesh.size = section.number("size");
  if (extension == ".msh") section.refuse("size", "has no effect on a .msh file; remove it");
}

void read_box(const SectionValues& section, int dimension, MeshCase& mesh) {
  section.refuse("size", "has no effect on a box; use cells");
  mesh.lower = section.vector("lower", Vec3::Zero(), 0);
  mesh.upper = section.vector("upper", Vec3::Ones(), 0);
  const std::vector<std::int64_t> cells = section.counts("cells");
  double n_cells = 1;
  mesh.cells = {1, 1, 1};
  for (int i = 0; i < dimension; ++i) {
    if (!(mesh.lower[i] < mesh.upper[i])) {
      section.fail(section.has("upper") ? "upper" : "lower",
                   fmt::format("leaves no box: {} to {} in direction {}; upper must exceed lower",
                               mesh.lower[i], mesh.upper[i], "xyz"[i]));
    }
    mesh.cells[static_cast<size_t>(i)] = static_cast<int>(cells[static_cast<size_t>(i)]);
    n_cells *= static_cast<double>(cells[static_cast<size_t>(i)]);
  }
  if (n_cells > 2e9) {
    section.fail("cells", fmt::format("makes {:.3g} cells; nodes are counted in 32 bits, so the "
                                      "most is 2e9",
                                      n_cells));
  }
}

MeshCase read_mesh(const SectionValues& section, const fs::path& folder, int dimension) {
  MeshCase mesh;
  mesh.element = section.menu_name("element");
  if (section.has("file")) {
    read_mesh_file(section, folder, mesh);
  } else {
    read_box(section, dimension, mesh);
  }
  mesh.perturbation = section.number("perturbation");
  if (!section.has("perturbation"))
    section.refuse("seed", "has no effect without mesh.perturbation; remove it");
  mesh.seed = static_cast<std::uint64_t>(section.integer("seed"));
  return mesh;
}

BoundaryCase read_boundary(const SectionValues& section, bool has_motion) {
  BoundaryCase boundary;
  boundary.where = section.where();
  boundary.groups = section.groups("group");
  boundary.type = section.menu_name("type");
  const bool takes_vector = boundary.type == "traction" || boundary.type == "velocity";
  if (boundary.type == "pressure") {
    boundary.pressure = section.scalar_field("value");
  } else if (takes_vector && section.is_word("value", "manufactured")) {
    if (!has_motion)
      section.fail("value", "= \"manufactured\" needs a motion; give it in [manufactured]");
    boundary.manufactured = true;
  } else if (takes_vector) {
    boundary.value = section.vector_field("value");
  } else if (boundary.type == "rigid-wall") {
    section.refuse("value", "has no effect on type = \"rigid-wall\"; remove it");
    boundary.point = section.required_vector("point");
    boundary.normal = section.direction("normal");
  } else {
    section.refuse("value",
                   fmt::format("has no effect on type = \"{}\"; remove it", boundary.type));
  }
  if (boundary.type != "rigid-wall") {
    for (const char* name : {"point", "normal"})
      section.refuse(
          name, fmt::format("has no effect on type = \"{}\"; it is for rigid-wall", boundary.type));
  }
  return boundary;
}

bool is_load(const BoundaryCase& b) {
  return b.type == "traction" || b.type == "pressure";
}
bool holds_all(const BoundaryCase& b) {
  return b.type == "fixed" || b.type == "velocity";
}

/// Whether both may act on one group: two different loads, or a load and a symmetry; a wall with
/// anything but another wall and what holds all.
bool agree(const BoundaryCase& a, const BoundaryCase& b) {
  if (a.type == "rigid-wall" || b.type == "rigid-wall")
    return a.type != b.type && !holds_all(a) && !holds_all(b);
  if (is_load(a) && is_load(b)) return a.type != b.type;
  return is_load(a) != is_load(b) && !holds_all(a) && !holds_all(b);
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

InitialCase read_initial(const SectionValues& section) {
  InitialCase initial;
  initial.displacement = section.vector_field("displacement");
  initial.velocity = section.vector_field("velocity");
  initial.deformation_gradient = section.tensor_field_if("deformation_gradient", true);
  initial.relaxed = section.menu_name("internal") == "relaxed";
  return initial;
}

/// The motion of [manufactured], or null; what it determines must not be given besides.
std::shared_ptr<const exact::Motion> read_motion(const Sections& sections) {
  if (sections.table("manufactured") == nullptr) return nullptr;
  const SectionValues section = sections.section("manufactured");
  section.vector_field("displacement");  // syntax and names, with the messages of expressions
  auto motion =
      std::make_shared<exact::Motion>(section.vector_texts("displacement"), sections.vocabulary);
  const auto refuse = [&](const char* place, const char* name) {
    sections.section(place).refuse(name,
                                   "is already given by the motion of [manufactured]; remove "
                                   "one of the two");
  };
  for (const char* name : {"displacement", "velocity", "deformation_gradient"})
    refuse("initial", name);
  refuse("load", "body_force");
  for (const char* name : {"displacement", "velocity", "deformation_gradient", "stress"})
    refuse("exact", name);
  return motion;
}

TimeCase read_time(const SectionValues& section) {
  TimeCase time;
  time.end = section.number("end");
  time.integrator = section.menu_name("integrator");
  time.speeds = section.menu_name("speeds");
  time.cfl = section.has("cfl") ? section.number("cfl") : 0;
  time.max_steps = section.integer("max_steps");
  return time;
}

SchemeCase read_scheme(const SectionValues& section) {
  SchemeCase scheme;
  scheme.unknowns = section.menu_name("unknowns");
  scheme.reconstruction = section.menu_name("reconstruction");
  scheme.limiter = section.menu_name("limiter");
  scheme.impedance = section.menu_name("impedance");
  scheme.dissipation = section.number("dissipation");
  scheme.face_correction = section.number("face_correction");
  scheme.precision = section.menu_name("precision");
  scheme.angular_momentum_projection = section.flag("angular_momentum_projection");
  scheme.energy_budget = section.flag("energy_budget");
  if (scheme.reconstruction == "none" && scheme.limiter != "none") {
    section.fail("limiter", fmt::format("= '{}' has no effect with reconstruction = \"none\"; use "
                                        "limiter = \"none\"",
                                        scheme.limiter));
  }
  if (scheme.precision == "single" && scheme.impedance == "exact") {
    section.fail("precision",
                 "= \"single\" has no exact impedance; use \"mixed\" or \"double\", or "
                 "impedance = \"isotropic\"");
  }
  return scheme;
}

FvmCase read_fvm(const SectionValues& section) {
  FvmCase fvm;
  fvm.stencil = section.menu_name("stencil");
  fvm.order = static_cast<int>(section.integer("order"));
  if (fvm.stencil != "sbp") {
    section.refuse("order",
                   fmt::format("has no effect on stencil = \"{}\"; it is for sbp", fvm.stencil));
  }
  if (fvm.order % 2 != 0) {
    section.fail("order",
                 fmt::format("= {} is not the order of an operator; use 2, 4 or 6", fvm.order));
  }
  return fvm;
}

ExactCase read_exact(const SectionValues& section) {
  ExactCase exact;
  exact.displacement = section.vector_field_if("displacement");
  exact.velocity = section.vector_field_if("velocity");
  exact.deformation_gradient = section.tensor_field_if("deformation_gradient", true);
  exact.stress = section.tensor_field_if("stress", false);
  return exact;
}

void read_sections(Sections& sections, const fs::path& folder, Case& c) {
  read_parameters(sections);
  read_functions(sections);
  c.title = sections.top().text("title");
  c.mesh.element = sections.section("mesh").menu_name("element");
  sections.dimension = dimension_of(c.mesh);
  c.mesh = read_mesh(sections.section("mesh"), folder, sections.dimension);
  const Value* material = sections.table("material");
  const Member* branches = material == nullptr ? nullptr : material->find("branch");
  c.material = read_material(
      sections.section("material"),
      sections.entries(branches == nullptr ? nullptr : &branches->value, "material.branch"));
  c.motion = read_motion(sections);
  c.initial = read_initial(sections.section("initial"));
  c.initial.motion = c.motion;
  for (const SectionValues& entry : sections.entries(sections.table("boundary"), "boundary"))
    c.boundaries.push_back(read_boundary(entry, c.motion != nullptr));
  check_contradictions(c.boundaries);
  c.body_force = sections.section("load").vector_field("body_force");
  c.time = read_time(sections.section("time"));
  c.output.frames = static_cast<int>(sections.section("output").integer("frames"));
  c.output.fields = sections.section("output").flag("fields");
  c.probes = read_probes(sections.entries(sections.table("probe"), "probe"), sections.vocabulary);
  c.references =
      read_references(sections.entries(sections.table("reference"), "reference"), c.probes, folder);
  c.scheme = read_scheme(sections.section("scheme"));
  c.sph.kernel = sections.section("sph").menu_name("kernel");
  c.sph.kappa = sections.section("sph").number("kappa");
  c.sph.closure = sections.section("sph").flag("closure");
  c.fvm = read_fvm(sections.section("fvm"));
  c.exact = read_exact(sections.section("exact"));
}

}  // namespace

std::string case_name(const std::string& path) {
  const fs::path file = path;
  const std::string folder =
      fs::absolute(file).lexically_normal().parent_path().filename().string();
  return file.filename() == "case.toml" && !folder.empty() ? folder : file.stem().string();
}

int dimension_of(const MeshCase& mesh) {
  return mesh.element == "triangle" || mesh.element == "quadrilateral" ? 2 : 3;
}

Case case_from_text(const std::string& text,
                    const std::string& name,
                    const std::vector<std::string>& overrides) {
  Value document = parse_document(text, name);
  check_keys(document);
  const CaseRecord record = record_of(document, name);
  const fs::path origin = record.file.empty() ? name : record.file;
  Case c;
  c.name = case_name(origin);
  c.file = fs::absolute(origin).lexically_normal().string();
  c.text = original_text(text);
  c.overrides = merged_overrides(record.overrides, overrides);
  c.hash = case_hash(c.text, c.overrides);
  apply_overrides(document, c.overrides);
  check_keys(document);
  Sections sections(document);
  read_sections(sections, origin.parent_path(), c);
  return c;
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  std::error_code ignored;  // what cannot be seen fails to open below
  fs::path file = path;
  if (fs::is_directory(file, ignored)) file /= "case.toml";
  if (!fs::exists(file, ignored))
    throw base::InputError("no case file '" + shown(path) + "'; give a .toml file or its folder");
  return case_from_text(bounded_file(file.string(), size_t{1} << 20, "a case file"), file.string(),
                        overrides);
}

}  // namespace diptych::cases
