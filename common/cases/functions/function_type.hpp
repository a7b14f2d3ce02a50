#pragma once
/// The types of [functions.NAME]: named functions of time, or of place and time. A new type: a file
/// of this folder with its class, or the reading of one of common/exact, and a line in
/// functions.def. Test: tests/common/cases/functions_test.cpp.

#include "common/base/registry.hpp"
#include "common/cases/section_keys.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych::cases {

using Function = std::shared_ptr<const functions::TimeFunction>;

struct FunctionType {
  std::string meaning;             ///< sentences of the reference of keys, or empty
  std::vector<Key> keys;           ///< whose entries stand with this type
  std::vector<std::string> names;  ///< of all keys that it takes
  /// @throws base::InputError
  std::function<Function(const std::string& name, const SectionValues& section)> read;
};

/// A type whose keys go to a struct of parameters. Keys that several types take have their entry
/// with the first of them (in functions.def), and the others bind() them.
/// @param make  (name, section, parameters) -> Function, with what the keys mean together
template <class Parameters, class Make>
FunctionType function_type(const std::string& meaning,
                           const SectionKeys<Parameters>& keys,
                           const Make& make) {
  return {meaning, keys.keys(), keys.names(),
          [keys, make](const std::string& name, const SectionValues& section) -> Function {
            return make(name, section, keys.read(section));
          }};
}

#define DIPTYCH_FUNCTION(type) FunctionType type();
#include "common/cases/functions/functions.def"
#undef DIPTYCH_FUNCTION

/// All of functions.def by name.
const base::Registry<FunctionType>& function_menu();

/// As many relaxation times as moduli. @throws base::InputError
void check_branches(const SectionValues& section, size_t n_moduli, size_t n_times);

}  // namespace diptych::cases
