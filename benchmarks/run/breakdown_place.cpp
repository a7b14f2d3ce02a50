#include "benchmarks/run/breakdown_place.hpp"

#include <string>

namespace diptych::harness {

namespace {

std::int64_t broken_node(const scheme::Snapshot& s) {
  std::int64_t least = 0;
  for (size_t a = 0; a < s.J.size(); ++a) {
    const bool is_sound = s.J[a] > 0 && s.F[a].allFinite() && s.v[a].allFinite();
    if (!is_sound) return static_cast<std::int64_t>(a);
    if (s.J[a] < s.J[static_cast<size_t>(least)]) least = static_cast<std::int64_t>(a);
  }
  return least;
}

/// The message with the user's number in the place of the solver's.
std::string renumbered(std::string message, std::int64_t node, std::int64_t number) {
  const std::string told = "at node " + std::to_string(node);
  const size_t begin = message.find(told), end = begin + told.size();
  const bool is_whole = begin != std::string::npos &&
                        (end == message.size() || message[end] < '0' || message[end] > '9');
  if (is_whole) message.replace(begin, told.size(), "at node " + std::to_string(number));
  return message;
}

}  // namespace

io::RunFailure failure_of(const base::BreakdownError& error,
                          const run::Solver& solver,
                          const scheme::PairGraph& graph,
                          std::int64_t step,
                          const std::vector<std::int32_t>& order) {
  const std::int64_t node = error.node() ? *error.node() : broken_node(solver.snapshot());
  const auto a = static_cast<size_t>(node);
  const algebra::Vec3& X = graph.X[a];
  return {renumbered(error.what(), node, order[a]),
          solver.time(),
          step,
          order[a],
          {{X[0], X[1], X[2]}}};
}

}  // namespace diptych::harness
