#include "benchmarks/study/variants.hpp"

#include "benchmarks/run/menus.hpp"
#include "common/base/error.hpp"

namespace diptych::harness {

Variation variation_of(const std::string& text) {
  const size_t equals = text.find('=');
  const std::string form = "; write KEY=VALUE,VALUE, as in sph.kappa=1.0,1.2";
  if (equals == std::string::npos || equals == 0)
    throw base::InputError("--vary " + text + " has no key" + form);
  Variation variation{text.substr(0, equals), {}};
  size_t begin = equals + 1;
  while (true) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    if (comma == begin) throw base::InputError("--vary " + text + " has an empty value" + form);
    variation.values.push_back(text.substr(begin, comma - begin));
    if (comma == text.size()) return variation;
    begin = comma + 1;
  }
}

std::vector<Variant> variants_of(const std::vector<std::string>& variations) {
  std::vector<Variant> variants{{}};
  for (const std::string& text : variations) {
    const Variation variation = variation_of(text);
    const std::string name = variation.key.substr(variation.key.rfind('.') + 1);
    std::vector<Variant> combined;
    for (const Variant& variant : variants) {
      for (const std::string& value : variation.values) {
        Variant next = variant;
        next.label += (next.label.empty() ? "" : " ") + name + "=" + value;
        next.overrides.push_back(variation.key + "=" + value);
        combined.push_back(std::move(next));
      }
    }
    variants = std::move(combined);
  }
  return variants;
}

cases::Case case_of_variant(const std::string& path,
                            const std::vector<std::string>& overrides,
                            const Variant& variant) {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), variant.overrides.begin(), variant.overrides.end());
  return harness::read_case(path, all);
}

}  // namespace diptych::harness
