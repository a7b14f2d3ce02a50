#include "benchmarks/study/variants.hpp"

#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"

#include <algorithm>

namespace diptych::harness {

namespace {

/// The values between the commas behind the key: those of a list, a call or a text in quotes part
/// nothing.
std::vector<std::string> values_of(const std::string& text) {
  const size_t equals = text.find('=');
  const std::string form =
      "; write KEY=VALUE,VALUE, as in sph.kappa=1.0,1.2 or mesh.cells=[4,4],[8,8]";
  if (equals == std::string::npos || equals == 0)
    throw base::InputError("--vary " + text + " has no key" + form);
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text.substr(equals + 1)) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (std::string("([{").find(c) != std::string::npos) {
      ++depth;
    } else if (std::string(")]}").find(c) != std::string::npos) {
      --depth;
    }
    if (c == ',' && depth == 0 && quote == 0) {
      values.emplace_back();
    } else {
      values.back() += c;
    }
  }
  if (depth != 0 || quote != 0)
    throw base::InputError("--vary " + text + " has a bracket or a quote that is not closed" +
                           form);
  if (std::find(values.begin(), values.end(), "") != values.end())
    throw base::InputError("--vary " + text + " has an empty value" + form);
  return values;
}

/// The last step of the key, with the one before it where that is a number.
std::string short_name(const std::string& key) {
  const size_t last = key.rfind('.');
  if (last == std::string::npos) return key;
  const bool is_number = key.find_first_not_of("0123456789", last + 1) == std::string::npos;
  if (!is_number || last == 0) return key.substr(last + 1);
  return key.substr(key.rfind('.', last - 1) + 1);
}

}  // namespace

std::vector<Variant> variants_of(const std::vector<std::string>& variations) {
  std::vector<Variant> variants{{}};
  for (const std::string& text : variations) {
    const std::vector<std::string> values = values_of(text);
    const std::string key = text.substr(0, text.find('='));
    for (auto value = values.begin(); value != values.end(); ++value) {
      if (std::find(values.begin(), value, *value) != value)
        throw base::InputError("--vary " + text + " has the value " + *value +
                               " twice; leave one out");
    }
    std::vector<Variant> combined;
    for (const Variant& variant : variants) {
      for (const std::string& value : values) {
        Variant next = variant;
        next.label += (next.label.empty() ? "" : " ") + short_name(key) + "=" + value;
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
