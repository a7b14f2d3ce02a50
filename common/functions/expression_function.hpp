#pragma once
/// An expression under a name: what later expressions of a case would otherwise have to repeat.
/// Test: tests/common/cases/functions_test.cpp.

#include "common/functions/expressions.hpp"

#include <utility>

namespace diptych::functions {

/// One name, NAME.
class ExpressionFunction : public TimeFunction {
 public:
  ExpressionFunction(std::string name, Expression expression)
      : name_(std::move(name)), expression_(std::move(expression)) {}
  std::vector<std::string> names() const override { return {name_}; }
  std::vector<double> values(double t) const override { return values_at(Vec3::Zero(), t); }
  const std::string& name() const { return name_; }
  const Expression& expression() const { return expression_; }
  bool depends_on_position() const override { return expression_.depends_on_position(); }
  std::vector<double> values_at(const Vec3& X, double t) const override {
    return {expression_(X, t)};
  }

 private:
  std::string name_;
  Expression expression_;
};

}  // namespace diptych::functions
