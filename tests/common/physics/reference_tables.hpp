#pragma once
/// Reading the tables of tests/reference (see the README there).

#include "tests/common/physics/body.hpp"
#include "tests/folders.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace diptych::tests {

/// A table by its file name; throws where it is missing or empty, so that no test passes unread.
inline nlohmann::json reference_table(const std::string& file) {
  const std::string path = tests_folder() + "/reference/" + file;
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path);
  auto table = nlohmann::json::parse(stream);
  if (table.empty()) throw std::runtime_error(path + " is empty");
  return table;
}

inline Mat3 matrix(const nlohmann::json& rows) {
  Mat3 M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      M(i, j) = rows.at(i).at(j).get<double>();
  return M;
}
inline SymmetricTensor<double> symmetric(const nlohmann::json& rows) {
  return algebra::to_symmetric(matrix(rows));
}

}  // namespace diptych::tests
