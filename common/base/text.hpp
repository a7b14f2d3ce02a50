#pragma once
/// Text for messages: edit distance and "did you mean", lines that fit a terminal.

#include <cstddef>
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

/// Every line in lines of at most `width` characters, broken at spaces; those that were broken go
/// on after as many spaces as `indent` says. A word that is longer stands alone.
std::string folded(std::string_view text, size_t indent, size_t width = 100);

}  // namespace diptych::base
