/// Where the operations of a program are kept, and what is worked out when the places are given and
/// once per instant; the operations themselves: placed_operations.cpp.

#include "common/functions/placed_program.hpp"

#include <algorithm>

namespace diptych::functions {

using algebra::n_lanes;

PlacedProgram::PlacedProgram(std::shared_ptr<const Program> program,
                             const std::vector<int>& results,
                             std::span<const Vec3> X)
    : program_(std::move(program)) {
  const auto n_blocks = (static_cast<std::int64_t>(X.size()) + n_lanes - 1) / n_lanes;
  width_ = static_cast<int>(std::clamp<std::int64_t>(n_blocks, 1, widest));
  n_strips_ = (n_blocks + width_ - 1) / width_;
  compile(results);
  move_to(X);
}

void PlacedProgram::move_to(std::span<const Vec3> X) {
  X_.assign(X.begin(), X.end());
  tabulate();
}

/// What the results are made of.
std::vector<char> PlacedProgram::needed(const std::vector<int>& results) const {
  std::vector<char> is_needed(static_cast<size_t>(program_->size()), 0);
  for (const int k : results)
    is_needed[static_cast<size_t>(k)] = 1;
  for (int k = program_->size() - 1; k >= 0; --k) {
    if (!is_needed[static_cast<size_t>(k)]) continue;
    const Operation& o = (*program_)[k];
    const int arguments[3] = {o.first, o.second, o.third};
    for (int i = 0; i < o.n_arguments(); ++i)
      is_needed[static_cast<size_t>(arguments[i])] = 1;
  }
  return is_needed;
}

void PlacedProgram::compile(const std::vector<int>& results) {
  where_.resize(static_cast<size_t>(program_->size()));
  const std::vector<char> is_needed = needed(results);
  place_scalars(is_needed);
  place_table(is_needed, results);
  place_registers(is_needed, results);
  for (const int k : results)
    results_.push_back(where_[static_cast<size_t>(k)]);
}

void PlacedProgram::place_scalars(const std::vector<char>& is_needed) {
  for (int k = 0; k < program_->size(); ++k) {
    if (!is_needed[static_cast<size_t>(k)] || (*program_)[k].on_position) continue;
    where_[static_cast<size_t>(k)] = {Kept::scalars, static_cast<int>(scalars_.size())};
    scalars_.push_back(k);
    constants_.push_back({Lanes{} + (*program_)[k].constant});
  }
}

auto PlacedProgram::instruction_of(int k, const std::vector<Operand>& where) const -> Instruction {
  Instruction instruction;
  instruction.operation = (*program_)[k];
  const Operation& o = instruction.operation;
  const int arguments[3] = {o.first, o.second, o.third};
  for (int i = 0; i < 3; ++i)  // what is not there is read like the first
    instruction.arguments[i] =
        where[static_cast<size_t>(i < o.n_arguments() ? arguments[i] : arguments[0])];
  return instruction;
}

/// Operations of the place alone; those that results or others read stay in the table.
void PlacedProgram::place_table(const std::vector<char>& is_needed,
                                const std::vector<int>& results) {
  std::vector<char> is_read(where_.size(), 0);
  for (const int k : results)
    is_read[static_cast<size_t>(k)] = 1;
  for (int k = 0; k < program_->size(); ++k) {
    const Operation& o = (*program_)[k];
    if (!is_needed[static_cast<size_t>(k)] || !o.is_mixed()) continue;
    const int arguments[3] = {o.first, o.second, o.third};
    for (int i = 0; i < o.n_arguments(); ++i)
      is_read[static_cast<size_t>(arguments[i])] = 1;
  }
  std::vector<Operand> at_start = where_;  // registers while the table is made
  for (int k = 0; k < program_->size(); ++k) {
    const auto at = static_cast<size_t>(k);
    const Operation& o = (*program_)[k];
    if (!is_needed[at] || !o.is_of_place()) continue;
    if (o.op == Operator::variable) {
      at_start[at] = {Kept::registers, o.first};
    } else {
      Instruction instruction = instruction_of(k, at_start);
      instruction.to = n_place_registers_++;
      at_start[at] = {Kept::registers, instruction.to};
      of_place_.push_back(instruction);
    }
    if (!is_read[at]) continue;
    kept_.push_back(at_start[at]);
    where_[at] = {Kept::table, n_table_++};
  }
}

/// For each sum the product that is worked out with it, or -1.  [operations]
std::vector<int> PlacedProgram::fused_products(const std::vector<char>& is_needed,
                                               const std::vector<int>& results) const {
  std::vector<int> n_readers(where_.size(), 0), product_of(where_.size(), -1);
  for (const int k : results)
    n_readers[static_cast<size_t>(k)] += 2;  // has to be there by itself
  for (int k = 0; k < program_->size(); ++k) {
    const Operation& o = (*program_)[k];
    const int arguments[3] = {o.first, o.second, o.third};
    for (int i = 0; is_needed[static_cast<size_t>(k)] && i < o.n_arguments(); ++i)
      ++n_readers[static_cast<size_t>(arguments[i])];
  }
  for (int k = 0; k < program_->size(); ++k) {
    const Operation& o = (*program_)[k];
    const bool is_sum = o.op == Operator::add || o.op == Operator::subtract;
    if (!is_needed[static_cast<size_t>(k)] || !o.is_mixed() || !is_sum) continue;
    for (const int argument : {o.second, o.first}) {
      const Operation& p = (*program_)[argument];
      const bool is_product = p.op == Operator::multiply || p.op == Operator::scale;
      if (is_product && p.is_mixed() && n_readers[static_cast<size_t>(argument)] == 1)
        product_of[static_cast<size_t>(k)] = argument;
    }
  }
  return product_of;
}

auto PlacedProgram::fused_instruction(int k, int product) const -> Instruction {
  const Operation& sum = (*program_)[k];
  const bool product_first = sum.first == product;
  Instruction instruction = instruction_of(product, where_);
  instruction.arguments[2] = where_[static_cast<size_t>(product_first ? sum.second : sum.first)];
  instruction.fusion = sum.op == Operator::add ? Fusion::plus
                       : product_first         ? Fusion::minus
                                               : Fusion::reversed_minus;
  return instruction;
}

/// Operations of place and time. A register is free again after the last one that reads it.
void PlacedProgram::place_registers(const std::vector<char>& is_needed,
                                    const std::vector<int>& results) {
  const int n = program_->size();
  const std::vector<int> product_of = fused_products(is_needed, results);
  std::vector<char> is_fused(where_.size(), 0);
  for (const int product : product_of) {
    if (product >= 0) is_fused[static_cast<size_t>(product)] = 1;
  }
  // operations that operation k reads when it is worked out, those of its product among them
  const auto read_by = [&](int k) {
    std::vector<int> all;
    const int product = product_of[static_cast<size_t>(k)];
    for (const int reader : {k, product}) {
      if (reader < 0) continue;
      const Operation& o = (*program_)[reader];
      const int arguments[3] = {o.first, o.second, o.third};
      for (int i = 0; i < o.n_arguments(); ++i) {
        const bool is_new = std::find(all.begin(), all.end(), arguments[i]) == all.end();
        if (arguments[i] != product && is_new) all.push_back(arguments[i]);
      }
    }
    return all;
  };
  std::vector<int> last_read(where_.size(), -1);
  for (int k = 0; k < n; ++k) {
    if (!is_needed[static_cast<size_t>(k)] || is_fused[static_cast<size_t>(k)]) continue;
    for (const int argument : read_by(k))
      last_read[static_cast<size_t>(argument)] = k;
  }
  for (const int k : results)
    last_read[static_cast<size_t>(k)] = n;
  std::vector<int> unused;
  const auto take = [&] {
    if (unused.empty()) return n_registers_++;
    const int r = unused.back();
    unused.pop_back();
    return r;
  };
  std::vector<char> is_placed(where_.size(), 0);
  const auto place = [&](int k) {
    is_placed[static_cast<size_t>(k)] = 1;
    where_[static_cast<size_t>(k)] = {Kept::registers, take()};
    return where_[static_cast<size_t>(k)].at;
  };
  // values of functions of the case first: a function gives all of its names at once
  for (int k = 0; k < n; ++k) {
    const Operation& o = (*program_)[k];
    if (!is_needed[static_cast<size_t>(k)] || o.op != Operator::given || !o.on_position) continue;
    auto call = std::find_if(calls_.begin(), calls_.end(),
                             [&](const GivenCall& c) { return c.function == o.first; });
    if (call == calls_.end()) {
      const auto& function = program_->givens()[static_cast<size_t>(o.first)];
      calls_.push_back({o.first, static_cast<int>(function->names().size()), {}});
      call = calls_.end() - 1;
    }
    call->names.emplace_back(o.second, place(k));
  }
  // sine and cosine of the same argument, which are worked out together
  std::vector<int> sine_of(where_.size(), -1), cosine_of(where_.size(), -1);
  for (int k = 0; k < n; ++k) {
    const Operation& o = (*program_)[k];
    if (!is_needed[static_cast<size_t>(k)] || !o.is_mixed()) continue;
    if (o.op == Operator::sin) sine_of[static_cast<size_t>(o.first)] = k;
    if (o.op == Operator::cos) cosine_of[static_cast<size_t>(o.first)] = k;
  }
  for (int k = 0; k < n; ++k) {
    const Operation o = (*program_)[k];
    const auto at = static_cast<size_t>(k);
    if (!is_needed[at] || !o.is_mixed() || is_placed[at] || is_fused[at]) continue;
    const int product = product_of[at];
    Instruction instruction =
        product < 0 ? instruction_of(k, where_) : fused_instruction(k, product);
    const bool is_turn = o.op == Operator::sin || o.op == Operator::cos;
    const int sine = is_turn ? sine_of[static_cast<size_t>(o.first)] : -1;
    const int cosine = is_turn ? cosine_of[static_cast<size_t>(o.first)] : -1;
    if (sine >= 0 && cosine >= 0) {
      instruction.operation.op = Operator::sin;
      instruction.to = place(sine);
      instruction.also = place(cosine);
    } else {
      instruction.to = place(k);
    }
    for (const int argument : read_by(k)) {
      const Operand& where = where_[static_cast<size_t>(argument)];
      if (last_read[static_cast<size_t>(argument)] == k && where.in == Kept::registers)
        unused.push_back(where.at);
    }
    mixed_.push_back(instruction);
  }
}

void PlacedProgram::tabulate() {
  table_.resize(static_cast<size_t>(n_strips_ * n_table_ * width_));
  const auto n = static_cast<std::int64_t>(X_.size());
  parallel::for_shares(n_strips_, [&](std::int64_t strip) {
    std::vector<LaneBlock> registers(static_cast<size_t>(n_place_registers_ * width_));
    for (int a = 0; a < width_ * n_lanes; ++a) {
      const std::int64_t place = std::min(strip * width_ * n_lanes + a, n - 1);
      for (int i = 0; i < 3; ++i)
        registers[static_cast<size_t>(i * width_ + a / n_lanes)].v[a % n_lanes] =
            X_[static_cast<size_t>(place)][i];
    }
    for (const Instruction& instruction : of_place_)
      run(instruction, strip, constants_.data(), registers.data());
    for (int k = 0; k < n_table_; ++k) {
      const Blocks from =
          blocks(kept_[static_cast<size_t>(k)], strip, constants_.data(), registers.data());
      std::copy(from.first, from.first + width_, table_.begin() + (strip * n_table_ + k) * width_);
    }
  });
}

auto PlacedProgram::at(double t) const -> Instant {
  Instant instant = constants_;
  std::vector<double> values(scalars_.size());
  std::vector<std::vector<double>> given(program_->givens().size());
  for (size_t s = 0; s < scalars_.size(); ++s) {
    const Operation& o = (*program_)[scalars_[s]];
    if (o.op == Operator::variable) {
      values[s] = t;
    } else if (o.is_constant()) {
      values[s] = o.constant;
    } else if (o.op == Operator::given) {
      auto& of_function = given[static_cast<size_t>(o.first)];
      if (of_function.empty())
        of_function = program_->givens()[static_cast<size_t>(o.first)]->values(t);
      values[s] = of_function[static_cast<size_t>(o.second)];
    } else {
      const int arguments[3] = {o.first, o.second, o.third};
      double x[3] = {0, 0, 0};
      for (int i = 0; i < o.n_arguments(); ++i)
        x[i] = values[static_cast<size_t>(where_[static_cast<size_t>(arguments[i])].at)];
      values[s] = result_of(o, x[0], x[1], x[2]);
    }
    instant[s].v = Lanes{} + values[s];
  }
  return instant;
}

auto PlacedProgram::workspace() const -> Workspace {
  return {std::vector<LaneBlock>(static_cast<size_t>(n_registers_ * width_)), {}};
}

void PlacedProgram::call(const GivenCall& given,
                         std::int64_t strip,
                         double t,
                         Workspace& workspace) const {
  const std::int64_t n = width_ * n_lanes, first = strip * n;
  const std::int64_t there = std::min(n, n_places() - first);
  workspace.given.resize(static_cast<size_t>(n * given.n_names));
  const TimeFunction& function = *program_->givens()[static_cast<size_t>(given.function)];
  function.values_at_all({X_.data() + first, static_cast<size_t>(there)}, t,
                         workspace.given.data());
  for (const auto& [name, to] : given.names) {
    for (std::int64_t a = 0; a < n; ++a) {
      workspace.registers[static_cast<size_t>(to * width_ + a / n_lanes)].v[a % n_lanes] =
          workspace.given[static_cast<size_t>(std::min(a, there - 1) * given.n_names + name)];
    }
  }
}

}  // namespace diptych::functions
