#pragma once
/// The page of an atlas: for each method a picture of the map and a table with the reason in each
/// cell. One file without scripts. Test: tests/report/atlas_page_test.cpp

#include <string>
#include <vector>

namespace diptych::report {

/// A point of a map. States: stable, stopped, wrong, refused, unfinished; empty: no such point, or
/// not yet run.
struct AtlasCell {
  std::string state, reason;
  std::string before;  ///< its state in an earlier map, or empty
};

struct AtlasPicture {
  std::string method;
  std::string row_axes, column_axes;              ///< "nodes, kappa"
  std::vector<std::vector<std::string>> rows;     ///< of each row the names of its choices
  std::vector<std::vector<std::string>> columns;  ///< of each column
  std::vector<std::vector<AtlasCell>> cells;      ///< by row, then column
};

/// @param verdict  HTML
/// @param text     below the maps: counts and causes
std::string atlas_page(const std::string& title,
                       const std::string& lead,
                       const std::string& verdict,
                       const std::vector<AtlasPicture>& pictures,
                       const std::string& text);

}  // namespace diptych::report
