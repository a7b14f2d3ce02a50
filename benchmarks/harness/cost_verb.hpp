#pragma once
/// The verb `cost`: tables on the terminal and as CSV in a folder.

#include <string>
#include <vector>

namespace diptych::harness {

/// Options of the scheme, relative to the scene that each is added to.
void report_option_costs(const std::string& folder, bool quiet);

/// Bodies of different size. @param sides  nodes along a side of the cubes
void report_size_costs(const std::vector<int>& sides,
                       int threads,
                       const std::string& folder,
                       bool quiet);

}  // namespace diptych::harness
