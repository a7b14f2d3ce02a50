#pragma once
/// A function of reference position and time that conditions get from outside, at one place or at
/// many together: what depends on the place alone is then worked out once.

#include "common/algebra/vectors.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace diptych::scheme {

using algebra::Vec3;

/// A field at given places, for one instant after the other.
template <class Value>
class PlacedField {
 public:
  virtual ~PlacedField() = default;
  virtual std::vector<Value> at(double t) const = 0;  ///< [places]
};

/// @tparam Value  Vec3 or double
template <class Value>
class FieldFunction {
 public:
  using AtPlace = std::function<Value(const Vec3& X, double t)>;
  using Placing = std::function<std::unique_ptr<PlacedField<Value>>(std::span<const Vec3> X)>;

  FieldFunction() = default;  ///< empty
  template <std::invocable<const Vec3&, double> Function>
  FieldFunction(Function at_place)  // NOLINT: any function of place and time is one
      : at_place_(std::make_shared<const AtPlace>(std::move(at_place))) {}
  /// How it depends on the place.
  struct InPlace {
    std::vector<double> instants;  ///< s, at which that shows; none: it does not
    bool travels = false;          ///< at other times in another way, more than by factors of time
  };
  /// @param placing  the same at many places
  FieldFunction(AtPlace at_place, Placing placing, InPlace in_place = {})
      : at_place_(std::make_shared<const AtPlace>(std::move(at_place))),
        placing_(std::move(placing)),
        in_place_(std::move(in_place)) {}

  explicit operator bool() const { return at_place_ != nullptr; }
  Value operator()(const Vec3& X, double t) const { return (*at_place_)(X, t); }
  const InPlace& in_place() const { return in_place_; }
  bool is_same(const FieldFunction& other) const { return at_place_ == other.at_place_; }

  std::unique_ptr<PlacedField<Value>> placed(std::span<const Vec3> X) const {
    if (placing_) return placing_(X);
    return std::make_unique<OneByOne>(at_place_, std::vector<Vec3>(X.begin(), X.end()));
  }

 private:
  class OneByOne : public PlacedField<Value> {
   public:
    OneByOne(std::shared_ptr<const AtPlace> at_place, std::vector<Vec3> X)
        : at_place_(std::move(at_place)), X_(std::move(X)) {}
    std::vector<Value> at(double t) const override {
      std::vector<Value> values;
      values.reserve(X_.size());
      for (const Vec3& X : X_)
        values.push_back((*at_place_)(X, t));
      return values;
    }

   private:
    std::shared_ptr<const AtPlace> at_place_;
    std::vector<Vec3> X_;
  };

  std::shared_ptr<const AtPlace> at_place_;
  Placing placing_;
  InPlace in_place_;
};

}  // namespace diptych::scheme
