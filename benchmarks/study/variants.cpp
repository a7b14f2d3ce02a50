#include "benchmarks/study/variants.hpp"

#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"

#include <algorithm>

namespace diptych::harness {

namespace {

/// The values between the commas behind the key.
std::vector<std::string> values_of(const std::string& text) {
  const size_t equals = text.find('=');
  const std::string form = "; write KEY=VALUE,VALUE, as in sph.kappa=1.0,1.2";
  if (equals == std::string::npos || equals == 0)
    throw base::InputError("--vary " + text + " has no key" + form);
  std::vector<std::string> values(1);
  for (const char c : text.substr(equals + 1)) {
    if (c == ',') {
      values.emplace_back();
    } else {
      values.back() += c;
    }
  }
  if (std::find(values.begin(), values.end(), "") != values.end())
    throw base::InputError("--vary " + text + " has an empty value" + form);
  return values;
}

/// "sph" of "sph.kappa=1.2"; empty where the key is of no one method.
std::string method_of_key(const std::string& override) {
  const std::string section = override.substr(0, override.find('.'));
  return section == "sph" || section == "fvm" ? section : "";
}

void add_override(Variant& variant, const std::string& override) {
  const std::string key = override.substr(0, override.find('='));
  variant.label += (variant.label.empty() ? "" : " ") + override.substr(key.rfind('.') + 1);
  variant.overrides.push_back(override);
}

/// Of each method those that differ by what it reads.
std::vector<Variant> by_method(const std::vector<Variant>& variants) {
  std::vector<Variant> split;
  for (const char* method : {"sph", "fvm"}) {
    for (const Variant& variant : variants) {
      Variant own;
      own.method = method;
      for (const std::string& override : variant.overrides) {
        const std::string of = method_of_key(override);
        if (of.empty() || of == method) add_override(own, override);
      }
      const bool is_new = std::none_of(split.begin(), split.end(), [&](const Variant& one) {
        return one.method == own.method && one.overrides == own.overrides;
      });
      if (is_new) split.push_back(std::move(own));
    }
  }
  return split;
}

}  // namespace

std::vector<Variant> variants_of(const std::vector<std::string>& variations) {
  std::vector<Variant> variants{{}};
  for (const std::string& text : variations) {
    const std::vector<std::string> values = values_of(text);
    const std::string key = text.substr(0, text.find('='));
    std::vector<Variant> combined;
    for (const Variant& variant : variants) {
      for (const std::string& value : values) {
        combined.push_back(variant);
        add_override(combined.back(), key + "=" + value);
      }
    }
    variants = std::move(combined);
  }
  const bool has_own_keys =
      std::any_of(variants.front().overrides.begin(), variants.front().overrides.end(),
                  [](const std::string& override) { return !method_of_key(override).empty(); });
  return has_own_keys ? by_method(variants) : variants;
}

std::vector<Variant> variants_of_columns(const std::vector<Column>& columns) {
  std::vector<Variant> variants;
  for (const Column& column : columns)
    variants.push_back({column.variant, {}, column.method, column.set});
  return variants;
}

cases::Case case_of_variant(const std::string& path,
                            const std::vector<std::string>& overrides,
                            const Variant& variant) {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), variant.overrides.begin(), variant.overrides.end());
  all.insert(all.end(), variant.set.begin(), variant.set.end());
  return harness::read_case(path, all);
}

}  // namespace diptych::harness
