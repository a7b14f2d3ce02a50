#include "common/cases/functions/function_type.hpp"
#include "common/functions/expression_function.hpp"

namespace diptych::cases {

namespace {

struct Parameters {
  functions::Expression value;
};

}  // namespace

FunctionType expression() {
  const auto keys =
      SectionKeys<Parameters>("functions.*")
          .key("value", &Parameters::value,
               {"-", any, "What the name stands for.", "\"sin(pi*t/T)^2\"", "with expression"});
  return function_type("expression gives NAME.", keys,
                       [](const std::string& name, const SectionValues&, const Parameters& p) {
                         return std::make_shared<functions::ExpressionFunction>(name, p.value);
                       });
}

}  // namespace diptych::cases
