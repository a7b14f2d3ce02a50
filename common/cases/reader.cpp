#include "common/cases/reader.hpp"

#include "common/base/error.hpp"
#include "common/cases/bounded_file.hpp"
#include "common/cases/copy.hpp"
#include "common/cases/document.hpp"
#include "common/cases/sections/sections.hpp"
#include "meshes/generators.hpp"

#include <filesystem>

namespace diptych::cases {

namespace fs = std::filesystem;

std::string case_name(const std::string& path) {
  const fs::path file = path;
  const std::string folder =
      fs::absolute(file).lexically_normal().parent_path().filename().string();
  return file.filename() == "case.toml" && !folder.empty() ? folder : file.stem().string();
}

int dimension_of(const MeshCase& mesh) {
  return meshes::dimension_of(meshes::cell_menu().at(mesh.element));
}

Case case_from_text(const std::string& text,
                    const std::string& name,
                    const std::vector<std::string>& overrides,
                    const Menus& menus) {
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
  Reading reading{.document = document, .menus = menus, .folder = origin.parent_path()};
  for (const SectionEntry& entry : section_entries())
    entry.read(reading, c);
  return c;
}

Case read_case(const std::string& path,
               const std::vector<std::string>& overrides,
               const Menus& menus) {
  std::error_code ignored;  // what cannot be seen fails to open below
  fs::path file = path;
  if (fs::is_directory(file, ignored)) file /= "case.toml";
  if (!fs::exists(file, ignored))
    throw base::InputError("no case file '" + shown(path) + "'; give a .toml file or its folder");
  return case_from_text(bounded_file(file.string(), size_t{1} << 20, "a case file"), file.string(),
                        overrides, menus);
}

}  // namespace diptych::cases
