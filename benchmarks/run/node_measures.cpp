#include "benchmarks/run/node_measures.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace diptych::harness {

namespace {

/// The node whose fields the expressions see; there is one, as there is one state at a time.
struct CurrentNode {
  const NodeStates* nodes = nullptr;
  size_t a = 0;
};

CurrentNode& current_node() {
  static thread_local CurrentNode node;
  return node;
}

/// Fields of the current node as names of the expression language.
class NodeFields : public functions::TimeFunction {
 public:
  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (const char* vector : {"u", "v"}) {
      for (int i = 1; i <= 3; ++i)
        all.push_back(fmt::format("{}{}", vector, i));
    }
    for (const char* tensor : {"F", "P"}) {
      for (int k = 0; k < 9; ++k)
        all.push_back(fmt::format("{}{}{}", tensor, k / 3 + 1, k % 3 + 1));
    }
    all.push_back("J");
    for (const std::string& field : error_fields())
      all.push_back("error_" + field);
    return all;
  }
  std::vector<double> values(double t) const override {
    return values_at(algebra::Vec3::Zero(), t);
  }
  bool depends_on_position() const override { return true; }
  std::vector<double> values_at(const algebra::Vec3& /*X*/, double /*t*/) const override {
    const CurrentNode& node = current_node();
    std::vector<double> all(25 + error_fields().size(), 0.0);
    if (node.nodes == nullptr) return all;  // while an expression is compiled
    const scheme::Snapshot& s = node.nodes->state;
    for (int i = 0; i < 3; ++i) {
      all[i] = s.u[node.a][i];
      all[3 + i] = s.v[node.a][i];
    }
    for (int k = 0; k < 9; ++k) {
      all[6 + k] = s.F[node.a](k / 3, k % 3);
      all[15 + k] = s.P[node.a](k / 3, k % 3);
    }
    all[24] = s.J[node.a];
    for (size_t k = 0; k < error_fields().size(); ++k) {
      const auto found = node.nodes->errors.find(error_fields()[k]);
      all[25 + k] = found == node.nodes->errors.end() ? std::numeric_limits<double>::quiet_NaN()
                                                      : found->second[node.a];
    }
    return all;
  }
};

double reduced(const NodeMeasure& measure, const NodeStates& nodes) {
  const scheme::PairGraph& graph = nodes.graph;
  const double t = nodes.state.time;
  double sum = 0, volume = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (size_t a = 0; a < graph.X.size(); ++a) {
    current_node() = {&nodes, a};
    if (measure.where(graph.X[a], t) == 0) continue;
    const double value = measure.value(graph.X[a], t);
    sum += graph.Omega[a] * value;
    volume += graph.Omega[a];
    least = std::min(least, value);
    most = std::max(most, value);
  }
  current_node() = {};
  if (volume == 0) {
    throw base::InputError(
        fmt::format("measure '{}': its 'where' holds at no node; widen it", measure.name));
  }
  if (measure.reduce == "mean") return sum / volume;
  if (measure.reduce == "integral") return sum;
  return measure.reduce == "max" ? most : least;
}

}  // namespace

functions::Vocabulary node_vocabulary(const std::map<std::string, double>& parameters) {
  return {parameters, {std::make_shared<NodeFields>()}};
}

const std::vector<std::string>& reductions() {
  static const std::vector<std::string> all{"mean", "integral", "max", "min"};
  return all;
}

const std::vector<std::string>& error_fields() {
  static const std::vector<std::string> all{"velocity",  "displacement", "deformation_gradient",
                                            "cofactor",  "jacobian",     "stress",
                                            "viscous_C", "viscous_G"};
  return all;
}

std::map<std::string, double> measured(const std::vector<NodeMeasure>& measures,
                                       const NodeStates& nodes) {
  std::map<std::string, double> values;
  if (nodes.state.u.empty()) return values;
  for (const NodeMeasure& measure : measures)
    values[measure.name] = reduced(measure, nodes);
  return values;
}

}  // namespace diptych::harness
