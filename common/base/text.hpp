#pragma once
/// Text for messages: edit distance and "did you mean".

#include <string>
#include <string_view>
#include <vector>

namespace diptych::base {

/// Damerau-Levenshtein (optimal string alignment) distance, case-insensitive.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `names` to `word`, or an empty string where none is near (more than half of the
/// letters differ).
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean 'x'?" or, where nothing is near, "; known: a, b, c".
std::string suggestion(std::string_view word, const std::vector<std::string>& names);

/// "a, b, c"
std::string joined(const std::vector<std::string>& names, std::string_view separator = ", ");

}  // namespace diptych::base
