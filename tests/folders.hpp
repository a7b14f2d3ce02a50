#pragma once
/// Where the source tree, its tests and the build stand: known to one object file alone, so that
/// all others of the tests are the same bytes in every copy of the tree (a compiler cache finds
/// them again).

#include <string>

namespace diptych::tests {

/// @return the absolute path of the source tree, without a slash at its end
const std::string& source_folder();
/// @return the absolute path of tests/ there
const std::string& tests_folder();
/// @return the absolute path of the build's folder, where its programs are
const std::string& build_folder();

}  // namespace diptych::tests
