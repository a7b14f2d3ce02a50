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
    for (const auto& [field, norm] : field_norms(graph_, output.state))
      largest_[field] = std::max(largest_[field], norm);
  }
  const std::map<std::string, double>& largest() const { return largest_; }

 private:
  const scheme::PairGraph& graph_;
  std::map<std::string, double> largest_;
};

}  // namespace diptych::run
