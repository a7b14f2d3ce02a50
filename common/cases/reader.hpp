#pragma once
/// Case files (TOML) to cases. Every key is checked against the table of keys.hpp: unknown,
/// duplicate, ill-typed, missing, inadmissible and idle keys are errors with file:line:column.

#include "common/cases/case.hpp"
#include "common/cases/keys.hpp"

#include <string>
#include <vector>

namespace diptych::cases {

/// @param path       of a case file, or of a folder that holds case.toml
/// @param overrides  "key=value", as of --set: "material.poissons_ratio=0.45",
///                   "parameters.tau=1e-3", "material.branch.0.tau_C=1e-3"
/// @param menus      of the rooms above; a name whose menu is not among them is looked up, and
///                   refused, by the room that takes it
/// @throws base::InputError, base::EnvironmentError (cannot be read)
Case read_case(const std::string& path,
               const std::vector<std::string>& overrides = {},
               const Menus& menus = {});

/// The same of a text in memory.
/// @param name  stands for the path: in messages, and as the base of relative mesh files
Case case_from_text(const std::string& text,
                    const std::string& name,
                    const std::vector<std::string>& overrides = {},
                    const Menus& menus = {});

/// Name of the case in this file: the folder of a .../NAME/case.toml, else the file without its
/// ending.
std::string case_name(const std::string& path);

/// Dimension that the cell type implies: 2 (triangle, quadrilateral) or 3.
int dimension_of(const MeshCase& mesh);

/// Hash of a case: the text as read and the overrides in any order; 16 hexadecimal digits.
std::string case_hash(const std::string& text, const std::vector<std::string>& overrides);

}  // namespace diptych::cases
