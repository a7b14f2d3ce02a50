#pragma once
/// The largest L2 norm of each field over the output times.

#include "common/run/field_norms.hpp"
#include "common/run/observers/observer.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace diptych::run {

class FieldScales : public Observer {
 public:
  /// @param graph  kept by reference
  explicit FieldScales(const scheme::PairGraph& graph) : graph_(graph) {}

  void at_output(const Output& output) override {
    for (const auto& [field, norm] : field_norms(graph_, output.state.fields()))
      largest_[field] = std::max(largest_[field], norm);
  }
  void archive(algebra::Archive& archive) override {
    std::vector<std::string> fields;
    std::vector<double> norms;
    for (const auto& [field, norm] : largest_) {
      fields.push_back(field);
      norms.push_back(norm);
    }
    archive.texts("scales/fields", fields);
    archive.reals("scales/largest norms", "-", norms, 1, static_cast<std::int64_t>(fields.size()));
    for (size_t k = 0; k < fields.size(); ++k)
      largest_[fields[k]] = norms[k];
  }
  const std::map<std::string, double>& largest() const { return largest_; }

 private:
  const scheme::PairGraph& graph_;
  std::map<std::string, double> largest_;
};

}  // namespace diptych::run
