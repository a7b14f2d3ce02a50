#include "tests/folders.hpp"

namespace diptych::tests {

const std::string& source_folder() {
  static const std::string folder = DIPTYCH_SOURCE_DIR;
  return folder;
}

const std::string& tests_folder() {
  static const std::string folder = source_folder() + "/tests";
  return folder;
}

const std::string& build_folder() {
  static const std::string folder = DIPTYCH_BUILD_DIR;
  return folder;
}

}  // namespace diptych::tests
