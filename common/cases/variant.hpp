#pragma once
/// Variants of a case, from [[variant]] of its file and from the option --with: a name and settings
/// that belong to one method, or to both. Test: tests/common/cases/variant_test.cpp

#include "common/cases/case.hpp"

#include <string>
#include <vector>

namespace diptych::cases {

/// The variant that a text says: "sph.kappa=0.75", or with a name "compact: sph.kappa=0.75", or
/// several settings with blanks or ';' between them. Without a name it is called after its
/// settings, "kappa=0.75+gradient=sbp". The settings are not yet looked at.
VariantCase variant_from_text(const std::string& text);

/// Adds a variant to those that there are; one that sets keys of a method becomes that method's.
/// @throws base::InputError on a name that is not fit for a folder or that a variant of the same
///         method has, no setting, one that the table of keys does not know, keys of both methods,
///         and keys of another method than the variant's
void add_variant(VariantCase variant, std::vector<VariantCase>& variants);

/// The first setting of a variant that the case has by itself, as "sph.kappa = 0.75"; empty where
/// every one makes a difference. @param changed  the case with the settings
std::string setting_in_common(const VariantCase& variant, const Case& setup, const Case& changed);

}  // namespace diptych::cases
