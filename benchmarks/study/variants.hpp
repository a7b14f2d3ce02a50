#pragma once
/// The variants of a case that a study runs: every combination of the values that --vary lists, and
/// beside them those of --with and of the case file.
/// Test: tests/harness/variants_test.cpp

#include "benchmarks/run/columns.hpp"
#include "common/cases/case.hpp"

#include <string>
#include <vector>

namespace diptych::harness {

/// One combination.
struct Variant {
  std::string label;                   ///< "kappa=1.0 integrator=leapfrog"; empty: the case itself
  std::vector<std::string> overrides;  ///< "sph.kappa=1.0", ... of --vary
  std::string method = {};             ///< whose it is; empty: of all
  std::vector<std::string> set = {};   ///< "key=value" of --with or of the case file
};

/// All combinations of texts like "sph.kappa=1.0,1.2", the last variation fastest; one without
/// overrides where none is asked. @throws base::InputError where there is no key, no '=' or an
/// empty value
std::vector<Variant> variants_of(const std::vector<std::string>& variations);

/// The same for the columns of variants, whose names are their labels.
std::vector<Variant> variants_of_columns(const std::vector<Column>& columns);

/// The case of a variant. @throws base::InputError as case files do
cases::Case case_of_variant(const std::string& path,
                            const std::vector<std::string>& overrides,
                            const Variant& variant);

}  // namespace diptych::harness
