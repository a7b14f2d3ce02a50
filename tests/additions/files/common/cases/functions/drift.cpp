/// A motion at constant velocity: NAME = velocity t.

#include "common/cases/functions/function_type.hpp"

namespace diptych::cases {

namespace {

struct Parameters {
  double velocity = 0;  ///< m/s
  double delay = 0;     ///< s
};

class Drift : public functions::TimeFunction {
 public:
  Drift(std::string name, const Parameters& p) : name_(std::move(name)), p_(p) {}
  std::vector<std::string> names() const override { return {name_}; }
  std::vector<double> values(double t) const override { return {p_.velocity * (t - p_.delay)}; }

 private:
  std::string name_;
  Parameters p_;
};

}  // namespace

FunctionType drift() {
  const auto keys =
      SectionKeys<Parameters>("functions.*")
          .bind("velocity", &Parameters::velocity)
          .key("delay", &Parameters::delay, {"s", any, "When the drift begins (drift).", "0.1"});
  return function_type("drift gives NAME, velocity times time.", keys,
                       [](const std::string& name, const SectionValues&, const Parameters& p) {
                         return std::make_shared<Drift>(name, p);
                       });
}

}  // namespace diptych::cases
