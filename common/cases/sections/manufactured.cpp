#include "common/cases/sections/sections.hpp"

#include <memory>

namespace diptych::cases {

namespace {

/// The motion of [manufactured], or null; what it determines must not be given besides.
std::shared_ptr<const exact::Motion> read_motion(const Reading& reading) {
  if (reading.table("manufactured") == nullptr) return nullptr;
  const SectionValues section = reading.section("manufactured");
  section.vector_field("displacement");  // syntax and names, with the messages of expressions
  auto motion =
      std::make_shared<exact::Motion>(section.vector_texts("displacement"), reading.vocabulary);
  const auto refuse = [&](const char* place, const char* name) {
    reading.section(place).refuse(name,
                                  "is already given by the motion of [manufactured]; remove "
                                  "one of the two");
  };
  for (const char* name : {"displacement", "velocity", "deformation_gradient"})
    refuse("initial", name);
  refuse("load", "body_force");
  for (const char* name : {"displacement", "velocity", "deformation_gradient", "stress"})
    refuse("exact", name);
  return motion;
}

}  // namespace

SectionEntry manufactured_section() {
  const auto keys =
      SectionKeys<Case>("manufactured")
          .key("displacement", KeyType::vector_field,
               {"m", any,
                "Displacement u(X, t) of the motion x = X + u, smooth: + - * / ^, parameters, "
                "functions of type expression, and sin, cos, tan, their inverses, sinh, cosh, "
                "tanh, their inverses, exp, log, sqrt.",
                "[\"0.1*sin(3*t)*sin(pi*x)*cos(pi*y)\", \"0\", \"0\"]", "required in its section"});
  return {{"manufactured", false,
           "A motion that the body is made to follow (manufactured solution): body force, initial "
           "values, boundary values and exact fields are derived from it."},
          keys.keys(),
          [](Reading& reading, Case& setup) {
            setup.motion = setup.initial.motion = read_motion(reading);
          }};
}

}  // namespace diptych::cases
