#include "benchmarks/run/columns.hpp"

#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/copy.hpp"
#include "common/cases/document.hpp"
#include "common/cases/variant.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>

namespace diptych::harness {

namespace {

using cases::VariantCase;

std::string told(const VariantCase& variant) {
  return fmt::format("{}variant '{}' ", functions::prefix(variant.where), variant.name);
}

/// The case with the settings of a variant.
cases::Case changed_case(const cases::Case& setup, const VariantCase& variant) {
  try {
    return cases::case_from_text(setup.text, setup.file,
                                 cases::merged_overrides(setup.overrides, variant.set), menus());
  } catch (const base::InputError& error) {
    throw base::InputError(told(variant) + "makes no case: " + error.what());
  }
}

/// Whether --set says something of a key of the variant.
bool is_overridden(const VariantCase& variant, const cases::Case& setup) {
  const auto keys_of = [](const std::vector<std::string>& settings) {
    std::set<std::string> keys;
    for (const std::string& setting : settings)
      keys.insert(cases::key_of(setting));
    return keys;
  };
  const std::set<std::string> set = keys_of(setup.overrides), own = keys_of(variant.set);
  const auto is_set = [&](const std::string& key) {
    return std::any_of(set.begin(), set.end(),
                       [&](const auto& other) { return cases::are_of_one_value(key, other); });
  };
  return std::any_of(own.begin(), own.end(), is_set);
}

Column column_of(const cases::Case& setup, const VariantCase& variant, const std::string& method) {
  Column column{method, variant.name, variant.set, changed_case(setup, variant)};
  const std::string same = cases::setting_in_common(variant, setup, column.setup);
  if (same.empty()) return column;
  throw base::InputError(told(variant) + "sets " + same +
                         ", which the case has by itself; leave out what does not differ, or all "
                         "variants of the file with --no-variants");
}

}  // namespace

std::vector<Column> method_columns(const cases::Case& setup,
                                   const std::vector<std::string>& methods) {
  std::vector<Column> columns;
  for (const std::string& method : methods)
    columns.push_back({method, "", {}, setup});
  return columns;
}

std::vector<std::string> overridden_variants(const cases::Case& setup) {
  std::vector<std::string> names;
  for (const VariantCase& variant : setup.variants) {
    if (is_overridden(variant, setup)) names.push_back(variant.name);
  }
  return names;
}

std::vector<Column> variant_columns(const cases::Case& setup,
                                    const std::vector<std::string>& methods,
                                    const VariantRequest& request) {
  std::vector<VariantCase> variants;
  if (request.of_file) {
    std::copy_if(setup.variants.begin(), setup.variants.end(), std::back_inserter(variants),
                 [&](const VariantCase& variant) { return !is_overridden(variant, setup); });
  }
  const size_t n_of_file = variants.size();
  for (const std::string& text : request.with)
    cases::add_variant(cases::variant_from_text(text), variants);
  std::vector<Column> columns;
  for (size_t i = 0; i < variants.size(); ++i) {
    const VariantCase& variant = variants[i];
    const size_t n_before = columns.size();
    for (const std::string& method : methods) {
      if (variant.method.empty() || variant.method == method)
        columns.push_back(column_of(setup, variant, method));
    }
    if (columns.size() == n_before && i >= n_of_file) {
      throw base::InputError(fmt::format("{}is of {}, --method asks for {}", told(variant),
                                         variant.method, base::joined(methods)));
    }
  }
  return columns;
}

}  // namespace diptych::harness
