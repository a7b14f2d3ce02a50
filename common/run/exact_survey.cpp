#include "common/run/exact_survey.hpp"

#include "common/scheme/body/node_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

namespace diptych::run {

namespace {

enum Compared { velocity, displacement, deformation_gradient, cofactor, jacobian, stress, A, S };

double size_of(double value) {
  return std::abs(value);
}
template <class Field>
double size_of(const Field& value) {
  return value.norm();
}

/// Calls use(field, error, size) for every field that the exact solution gives: error(a) and
/// size(a) of node a are those of the difference and of the exact field.
template <class Use>
void for_compared(const cases::Case& setup,
                  const Snapshot& state,
                  const Snapshot& exact,
                  const Use& use) {
  const auto compare = [&](Compared name, const auto& field, const auto& known, const auto& rest) {
    using Field = std::remove_cvref_t<decltype(rest)>;
    if (known.empty()) return;
    use(
        name, [&](size_t a) { return size_of(Field(field[a] - known[a])); },
        [&](size_t a) { return size_of(Field(known[a] - rest)); });
  };
  const Vec3 zero = Vec3::Zero();
  const Mat3 I = Mat3::Identity(), O = Mat3::Zero();
  compare(velocity, state.v, exact.v, zero);
  compare(displacement, state.u, exact.u, zero);
  compare(deformation_gradient, state.F, exact.F, I);
  compare(cofactor, state.H, exact.H, I);
  compare(jacobian, state.J, exact.J, 1.0);
  compare(stress, state.P, exact.P, O);
  // only what branches relax: a C branch has no S, a G branch no A
  const auto compare_branches = [&](Compared name, const auto& fields, const auto& known,
                                    const auto& relaxes) {
    std::vector<size_t> branches;
    for (size_t k = 0; k < known.size() && k < fields.size(); ++k)
      if (relaxes(setup.material.branches[k])) branches.push_back(k);
    if (branches.empty()) return;
    const auto in_squares = [&](const auto& size) {
      double all = size(branches.front());
      for (size_t i = 1; i < branches.size(); ++i)
        all = std::hypot(all, size(branches[i]));
      return all;
    };
    use(
        name,
        [&](size_t a) {
          return in_squares([&](size_t k) { return size_of(Mat3(fields[k][a] - known[k][a])); });
        },
        [&](size_t a) {
          return in_squares([&](size_t k) { return size_of(Mat3(known[k][a] - I)); });
        });
  };
  compare_branches(A, state.A, exact.A, [](const auto& branch) { return branch.beta_C > 0; });
  compare_branches(S, state.S, exact.S, [](const auto& branch) { return branch.beta_G > 0; });
}

ExactSums sums_of_nodes(const cases::Case& setup,
                        const Snapshot& state,
                        const Snapshot& exact,
                        std::span<const double> Omega) {
  ExactSums sums;
  for_compared(setup, state, exact, [&](Compared field, const auto& error, const auto& size) {
    sums.has[field] = true;
    for (size_t a = 0; a < Omega.size(); ++a) {
      sums.fields[field].error.add(Omega[a], error(a));
      sums.fields[field].exact.add(Omega[a], size(a));
    }
  });
  sums.has_velocity = !exact.v.empty();
  for (size_t a = 0; a < exact.v.size(); ++a) {
    const double mass = setup.material.density * Omega[a];
    sums.kinetic += 0.5 * mass * exact.v[a].squaredNorm();
    sums.momentum += mass * exact.v[a];
    sums.momentum_scale += mass * exact.v[a].norm();
  }
  return sums;
}

/// Calls use(number) for all that stands in sums, in an order of its own.
template <class Sums, class Use>
void for_numbers(Sums& sums, const Use& use) {
  for (auto& field : sums.fields) {
    for (auto* size : {&field.error, &field.exact}) {
      use(size->l1);
      use(size->l2);
      use(size->linf);
    }
  }
  use(sums.kinetic);
  for (int i = 0; i < 3; ++i)
    use(sums.momentum[i]);
  use(sums.momentum_scale);
}

/// Chunk, what it has, and its numbers.
void put(std::int64_t chunk, const ExactSums& sums, std::vector<double>& answer) {
  answer.push_back(static_cast<double>(chunk));
  answer.push_back(sums.has_velocity ? 1 : 0);
  for (const bool has : sums.has)
    answer.push_back(has ? 1 : 0);
  for_numbers(sums, [&](double number) { answer.push_back(number); });
}

const double* take(const double* from, std::int64_t& chunk, ExactSums& sums) {
  chunk = static_cast<std::int64_t>(*from++);
  sums.has_velocity = *from++ != 0;
  for (bool& has : sums.has)
    has = *from++ != 0;
  for_numbers(sums, [&](double& number) { number = *from++; });
  return from;
}

}  // namespace

const std::array<std::string, 8>& compared_fields() {
  static const std::array<std::string, 8> names{"velocity",  "displacement", "deformation_gradient",
                                                "cofactor",  "jacobian",     "stress",
                                                "viscous_C", "viscous_G"};
  return names;
}

void SizeSums::add(double weight, double size) {
  l1 += weight * size;
  l2 += weight * size * size;
  linf = std::max(linf, size);
}

void SizeSums::add(const SizeSums& other) {
  l1 += other.l1;
  l2 += other.l2;
  linf = std::max(linf, other.linf);
}

void ExactSums::add(const ExactSums& other) {
  for (size_t k = 0; k < fields.size(); ++k) {
    has[k] = has[k] || other.has[k];
    fields[k].error.add(other.fields[k].error);
    fields[k].exact.add(other.fields[k].exact);
  }
  has_velocity = has_velocity || other.has_velocity;
  kinetic += other.kinetic;
  momentum += other.momentum;
  momentum_scale += other.momentum_scale;
}

double length_of(const scheme::PairGraph& graph) {
  return std::pow(graph.Omega[0], 1.0 / graph.dimension);
}

ExactSurvey::ExactSurvey(const cases::Case& setup,
                         const Solver& solver,
                         const scheme::PairGraph& graph)
    : ExactSurvey(setup, solver, Nodes{graph.X, graph.Omega, length_of(graph)}) {}

ExactSurvey::ExactSurvey(const cases::Case& setup, const Solver& solver, Nodes nodes)
    : setup_(setup), solver_(solver), length_(nodes.length), Omega_(std::move(nodes.Omega)) {
  const parallel::Part& part = solver.part();
  std::vector<std::int64_t> chunks = part.own_chunks();
  if (part.is_whole()) {
    chunks.resize(static_cast<size_t>(scheme::chunk_of_node(std::ssize(Omega_) - 1) + 1));
    std::iota(chunks.begin(), chunks.end(), 0);
  }
  place_of_chunk_.assign(chunks.empty() ? 0 : static_cast<size_t>(chunks.back() + 1), -1);
  for (size_t i = 0; i < chunks.size(); ++i)
    place_of_chunk_[static_cast<size_t>(chunks[i])] = static_cast<std::int64_t>(i);
  if (!setup.motion && !chunks.empty()) exact_.emplace(fields_at(std::move(nodes.X)));
}

ExactFields ExactSurvey::fields_at(std::vector<Vec3> X) const {
  return ExactFields(setup_, std::move(X), length_,
                     [&solver = solver_](const Mat3& F) { return solver.equilibrium_stress(F); });
}

void ExactSurvey::read_at(std::vector<std::int32_t> nodes, std::vector<Vec3> X) {
  read_ = std::move(nodes);
  if (!setup_.motion && !read_.empty()) exact_at_read_.emplace(fields_at(std::move(X)));
}

std::vector<double> ExactSurvey::answer(const Solver& solver, std::span<const double>) {
  const double t = solver.time();
  const std::optional<Snapshot> known = solver.exact_state(t);
  std::vector<ExactSums> sums(place_of_chunk_.size());
  std::vector<std::exception_ptr> refused(place_of_chunk_.size());
  solver.visit_own([&](std::int64_t chunk, std::int64_t first, const Snapshot& state) {
    try {
      const auto c = static_cast<size_t>(chunk);
      const std::int64_t begin = place_of_chunk_[c] * scheme::chunk_nodes, n = std::ssize(state.u);
      std::vector<std::int32_t> nodes;
      if (known) {
        nodes.resize(static_cast<size_t>(n));
        std::iota(nodes.begin(), nodes.end(), static_cast<std::int32_t>(first));
      }
      sums[c] =
          sums_of_nodes(setup_, state, known ? known->of(nodes) : exact_->at(t, begin, begin + n),
                        {Omega_.data() + begin, static_cast<size_t>(n)});
    } catch (...) {
      refused[static_cast<size_t>(chunk)] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : refused)
    if (error) std::rethrow_exception(error);
  // which one rank alone may refuse: after what all do together
  if (!read_.empty()) at_nodes_ = known ? known->of(read_) : exact_at_read_->at(t);
  at_nodes_.time = t;
  std::vector<double> answer;
  for (size_t c = 0; c < sums.size(); ++c)
    if (place_of_chunk_[c] >= 0) put(static_cast<std::int64_t>(c), sums[c], answer);
  return answer;
}

ExactSums sums_of(const Answers& answers) {
  std::map<std::int64_t, ExactSums> of_chunk;
  for (const std::vector<double>& answer : answers) {
    for (const double* from = answer.data(); from != answer.data() + answer.size();) {
      std::int64_t chunk = 0;
      ExactSums sums;
      from = take(from, chunk, sums);
      of_chunk.emplace(chunk, sums);
    }
  }
  ExactSums all;
  for (const auto& [chunk, sums] : of_chunk)
    all.add(sums);
  return all;
}

std::map<std::string, std::vector<double>> nodal_errors(const cases::Case& setup,
                                                        const Snapshot& state,
                                                        const Snapshot& exact) {
  std::map<std::string, std::vector<double>> errors;
  for_compared(setup, state, exact, [&](Compared field, const auto& error, const auto&) {
    std::vector<double>& of_nodes = errors[compared_fields()[field]];
    for (size_t a = 0; a < state.u.size(); ++a)
      of_nodes.push_back(error(a));
  });
  return errors;
}

}  // namespace diptych::run
