#pragma once
/// The verb `cost`: tables on the terminal and as CSV in a folder.

#include "benchmarks/cost/size_costs.hpp"

#include <string>

namespace diptych::harness {

/// Options of the scheme, relative to the scene that each is added to.
void report_option_costs(const std::string& folder, bool quiet);

/// Bodies of different size.
void report_size_costs(const SizeRequest& request, const std::string& folder);

}  // namespace diptych::harness
