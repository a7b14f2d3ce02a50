#pragma once
/// The variants of a case that a study runs: every combination of the values that --vary lists.
/// Test: tests/harness/variants_test.cpp

#include "common/cases/case.hpp"

#include <string>
#include <utility>
#include <vector>

namespace diptych::harness {

/// "sph.kappa=1.0,1.2": a key of the case file and the values it takes.
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

/// @throws base::InputError where there is no key, no '=' or an empty value
Variation variation_of(const std::string& text);

/// One combination.
struct Variant {
  std::string label;                   ///< "kappa=1.0 integrator=leapfrog"; empty: the case itself
  std::vector<std::string> overrides;  ///< "sph.kappa=1.0", ...
};

/// All combinations, the last variation fastest; one without overrides where none is asked.
std::vector<Variant> variants_of(const std::vector<std::string>& variations);

/// The case of a variant. @throws base::InputError as case files do
cases::Case case_of_variant(const std::string& path,
                            const std::vector<std::string>& overrides,
                            const Variant& variant);

}  // namespace diptych::harness
