#include "common/run/exact_errors.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::run {

void ExactErrors::measure(const ExactSums& sums) {
  for (size_t k = 0; k < sums.fields.size(); ++k) {
    if (!sums.has[k]) continue;
    const auto& [error, exact] = sums.fields[k];
    Norms& norms = norms_[compared_fields()[k]];
    norms.error = {error.l1, std::sqrt(error.l2), error.linf};
    if (norms.first < 0) norms.first = norms.error.l2;
    norms.scale.l1 = std::max(norms.scale.l1, exact.l1);
    norms.scale.l2 = std::max(norms.scale.l2, std::sqrt(exact.l2));
    norms.scale.linf = std::max(norms.scale.linf, exact.linf);
  }
}

void ExactErrors::archive(algebra::Archive& archive) {
  std::vector<std::string> names;
  for (const auto& [name, norms] : norms_)
    names.push_back(name);
  archive.texts("errors/fields", names);
  for (const std::string& name : names) {
    auto& [error, scale, first] = norms_[name];
    archive.real("errors/" + name + " l1", "-", error.l1);
    archive.real("errors/" + name + " l2", "-", error.l2);
    archive.real("errors/" + name + " linf", "-", error.linf);
    archive.real("errors/" + name + " scale l1", "-", scale.l1);
    archive.real("errors/" + name + " scale l2", "-", scale.l2);
    archive.real("errors/" + name + " scale linf", "-", scale.linf);
    archive.real("errors/" + name + " first", "-", first);
  }
}

std::map<std::string, double> ExactErrors::relative_at_first() const {
  std::map<std::string, double> result;
  for (const auto& [name, norms] : norms_)
    result[name] = norms.scale.l2 > 0 ? norms.first / norms.scale.l2 : 0;
  return result;
}

std::map<std::string, io::ErrorNorms> ExactErrors::relative() const {
  std::map<std::string, io::ErrorNorms> result;
  const auto ratio = [](double error, double scale) { return scale > 0 ? error / scale : error; };
  for (const auto& [name, norms] : norms_) {
    result[name] = {ratio(norms.error.l1, norms.scale.l1), ratio(norms.error.l2, norms.scale.l2),
                    ratio(norms.error.linf, norms.scale.linf)};
  }
  return result;
}

std::map<std::string, double> ExactErrors::scales() const {
  std::map<std::string, double> result;
  for (const auto& [name, norms] : norms_)
    result[name] = norms.scale.l2;
  return result;
}

}  // namespace diptych::run
