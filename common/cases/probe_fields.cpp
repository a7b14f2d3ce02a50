#include "common/cases/probe_fields.hpp"

#include "common/base/error.hpp"
#include "common/cases/stress_measures.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace diptych::cases {

std::vector<std::string> ProbeFields::names() const {
  std::vector<std::string> names;
  const std::string axes = "xyz";
  for (const char field : {'u', 'v'}) {
    for (const char i : axes)
      names.push_back({field, i});
  }
  for (const char field : {'F', 'P'}) {
    for (const char i : axes) {
      for (const char j : axes)
        names.push_back({field, i, j});
    }
  }
  for (const char* name : {"sxx", "syy", "szz", "sxy", "syz", "sxz", "mises", "p", "J"})
    names.emplace_back(name);
  return names;
}

std::vector<double> ProbeFields::values(double) const {
  std::vector<double> values;
  for (const Vec3* vector : {&node_.u, &node_.v}) {
    for (int i = 0; i < 3; ++i)
      values.push_back((*vector)[i]);
  }
  for (const Mat3* tensor : {&node_.F, &node_.P}) {
    for (int k = 0; k < 9; ++k)
      values.push_back((*tensor)(k / 3, k % 3));
  }
  const Mat3 sigma = cauchy_stress(node_.P, node_.F, node_.J);
  for (const double s :
       {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(0, 2)})
    values.push_back(s);
  values.push_back(von_mises(sigma));
  values.push_back(pressure(sigma));
  values.push_back(node_.J);
  return values;
}

void ProbeFields::check_names(const functions::Vocabulary& vocabulary,
                              const functions::SourcePlace& where) const {
  const std::vector<std::string> fields = names();
  const auto check = [&](const std::string& name) {
    if (std::find(fields.begin(), fields.end(), name) == fields.end()) return;
    throw base::InputError(fmt::format(
        "{}'{}' is a field in the quantities of probes; rename the parameter or function '{}'",
        functions::prefix(where), name, name));
  };
  for (const auto& [name, value] : vocabulary.parameters)
    check(name);
  for (const auto& function : vocabulary.time_functions) {
    for (const std::string& name : function->names())
      check(name);
  }
}

}  // namespace diptych::cases
