/// Programs at one place, and how they depend on place and time together.

#include "common/functions/program.hpp"

namespace diptych::functions {

namespace {

/// A function of a case, of place and time, at one place.
class AtPlace : public TimeFunction {
 public:
  AtPlace(std::shared_ptr<const TimeFunction> function, const Vec3& place)
      : function_(std::move(function)), place_(place) {}
  std::vector<std::string> names() const override { return function_->names(); }
  std::vector<double> values(double t) const override { return function_->values_at(place_, t); }

 private:
  std::shared_ptr<const TimeFunction> function_;
  Vec3 place_;
};

}  // namespace

int Program::append(const Expression& expression, const Vec3& place) {
  if (!expression.depends_on_position()) return append(expression);
  Program everywhere;
  const int result = everywhere.append(expression);
  return append_at(place, everywhere, result);
}

int Program::append_at(const Vec3& place, const Program& other, int result) {
  const std::vector<char> is_needed = other.made_of(result);
  std::vector<std::shared_ptr<const TimeFunction>> givens(other.givens_.size());
  std::vector<int> here(static_cast<size_t>(other.size()), -1);
  const auto at = [&](int k) { return k < 0 ? -1 : here[static_cast<size_t>(k)]; };
  for (int k = 0; k <= result; ++k) {
    if (is_needed[static_cast<size_t>(k)] == 0) continue;
    const Operation& o = other[k];
    int& found = here[static_cast<size_t>(k)];
    if (o.op == Operator::constant) {
      found = add_constant(o.constant);
    } else if (o.op == Operator::variable) {
      found = o.first < 3 ? add_constant(place[o.first]) : add(Operator::variable, o.first);
    } else if (o.op == Operator::given) {
      auto& given = givens[static_cast<size_t>(o.first)];
      const auto& function = other.givens_[static_cast<size_t>(o.first)];
      if (!given)
        given =
            function->depends_on_position() ? std::make_shared<AtPlace>(function, place) : function;
      found = add_given(given, o.second);
    } else {
      const int n = o.n_arguments();
      found = add(o.op, n > 0 ? at(o.first) : -1, n > 1 ? at(o.second) : -1, o.constant,
                  n > 2 ? at(o.third) : -1);
    }
  }
  return at(result);
}

bool Program::joins_place_and_time(int result) const {
  const std::vector<char> is_part = made_of(result);
  // conditions on place and on time, as of a product of both
  const auto joins = [this](int k) {
    const Operation& o = (*this)[k];
    return o.is_mixed() && o.op != Operator::both && o.op != Operator::either;
  };
  for (int k = 0; k <= result; ++k) {
    const Operation& o = (*this)[k];
    if (!is_part[static_cast<size_t>(k)] || !o.is_mixed()) continue;
    switch (o.op) {
      case Operator::add:
      case Operator::subtract:
      case Operator::multiply:
      case Operator::scale:
      case Operator::shift:
        continue;
      case Operator::divide:
        if ((*this)[o.second].is_mixed()) return true;
        continue;
      case Operator::choose:
        if (joins(o.first)) return true;
        continue;
      case Operator::both:
      case Operator::either:
        if (joins(o.first) || joins(o.second)) return true;
        continue;
      default:
        return true;
    }
  }
  return false;
}

bool Expression::joins_place_and_time() const {
  if (!depends_on_time() || !depends_on_position()) return false;
  Program program;
  return program.joins_place_and_time(program.append(*this));
}

}  // namespace diptych::functions
