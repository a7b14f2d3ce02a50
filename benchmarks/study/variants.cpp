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

}  // namespace

std::vector<Variant> variants_of(const std::vector<std::string>& variations) {
  std::vector<Variant> variants{{}};
  for (const std::string& text : variations) {
    const std::vector<std::string> values = values_of(text);
    const std::string key = text.substr(0, text.find('='));
    std::vector<Variant> combined;
    for (const Variant& variant : variants) {
      for (const std::string& value : values) {
        Variant next = variant;
        next.label +=
            (next.label.empty() ? "" : " ") + key.substr(key.rfind('.') + 1) + "=" + value;
        next.overrides.push_back(key + "=" + value);
        combined.push_back(std::move(next));
      }
    }
    variants = std::move(combined);
  }
  return variants;
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
