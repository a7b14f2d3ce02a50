#pragma once
/// Text and numbers as HTML.

#include <cstdint>
#include <string>
#include <string_view>

namespace diptych::report {

/// Safe as text and inside quoted attributes.
std::string escaped(std::string_view text);

/// Three significant digits: "0.0123", "452", "12 500", "1.23 × 10<sup>−4</sup>"; "n/a" where not
/// finite.
std::string number_html(double value);

/// Six significant digits, for values that are compared with each other.
std::string precise_html(double value);

/// Three digits, always with a power of ten, for columns of errors: "1.60 × 10<sup>−2</sup>".
std::string scientific_html(double value);

/// Whole number, thousands apart by narrow spaces.
std::string count_html(std::int64_t value);

/// Text for a <script> element: what could end the element early is written with a backslash, which
/// changes nothing inside strings and regular expressions.
std::string script_safe(std::string_view script);

/// JSON text for a <script> element: every "<" as \u003c.
std::string json_safe(std::string_view json);

}  // namespace diptych::report
