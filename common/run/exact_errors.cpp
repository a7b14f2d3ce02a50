#include "common/run/exact_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diptych::run {

NaturalSizes natural_sizes(const cases::Case& setup, const scheme::PairGraph& graph, double speed) {
  const double volume = std::accumulate(graph.Omega.begin(), graph.Omega.end(), 0.0);
  return {speed, std::pow(volume, 1.0 / graph.dimension), setup.material.density * speed * speed,
          volume};
}

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

io::ErrorNorms ExactErrors::natural_norms(const std::string& field) const {
  const double size = field == "velocity"       ? sizes_.speed
                      : field == "displacement" ? sizes_.length
                      : field == "stress"       ? sizes_.stress
                                                : 1;
  return {size * sizes_.volume, size * std::sqrt(sizes_.volume), size};
}

bool ExactErrors::is_at_rest(const std::string& field, const Norms& norms) const {
  constexpr double rounding = 1e-13;
  return norms.scale.l2 <= rounding * natural_norms(field).l2;
}

std::vector<std::string> ExactErrors::at_rest() const {
  std::vector<std::string> fields;
  for (const auto& [name, norms] : norms_)
    if (is_at_rest(name, norms)) fields.push_back(name);
  return fields;
}

std::map<std::string, double> ExactErrors::relative_at_first() const {
  std::map<std::string, double> result;
  for (const auto& [name, norms] : norms_)
    result[name] = is_at_rest(name, norms) ? 0 : norms.first / norms.scale.l2;
  return result;
}

std::map<std::string, io::ErrorNorms> ExactErrors::relative() const {
  std::map<std::string, io::ErrorNorms> result;
  for (const auto& [name, norms] : norms_) {
    const io::ErrorNorms scale = is_at_rest(name, norms) ? natural_norms(name) : norms.scale;
    result[name] = {norms.error.l1 / scale.l1, norms.error.l2 / scale.l2,
                    norms.error.linf / scale.linf};
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
