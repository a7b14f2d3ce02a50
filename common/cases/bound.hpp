#pragma once
/// Bounds as texts: "energy residual <= 1e-2", "J, final >= 0.99*J0". They stand in the section
/// [expect] of a case and in the files of atlases. Test: tests/common/cases/expect_test.cpp

#include "common/cases/case.hpp"

#include <map>
#include <string>

namespace diptych::cases {

/// @param parameters  that the value may use
/// @throws base::InputError where it is not FIGURE <= VALUE or FIGURE >= VALUE
BoundCase bound_from_text(const std::string& text,
                          const std::map<std::string, double>& parameters,
                          const functions::SourcePlace& where);

}  // namespace diptych::cases
