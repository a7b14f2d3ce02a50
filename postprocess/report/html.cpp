#include "postprocess/report/html.hpp"

#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace diptych::report {
namespace {

bool starts_ignoring_case(std::string_view text, std::string_view lower) {
  if (text.size() < lower.size()) return false;
  for (size_t i = 0; i < lower.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(text[i])) != lower[i]) return false;
  }
  return true;
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string scientific_html(double value) {
  if (!std::isfinite(value)) return "n/a";
  if (value == 0) return "0";
  const std::string text = fmt::format("{:.2e}", value);
  const size_t e = text.find('e');
  const int exponent = std::stoi(text.substr(e + 1));
  return fmt::format("{} × 10<sup>{}</sup>", with_minus(text.substr(0, e)),
                     with_minus(std::to_string(exponent)));
}

std::string precise_html(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || size < 1e-3 || size >= 1e6) return scientific_html(value);
  return with_minus(fmt::format("{:.6g}", value));
}

std::string number_html(double value) {
  const double size = std::abs(value);
  if (!std::isfinite(value) || value == 0 || size < 1e-3 || size >= 1e6) {
    return scientific_html(value);
  }
  if (size >= 99.95) return count_html(std::llround(value));
  const int decimals = size >= 9.995 ? 1 : size >= 0.9995 ? 2 : size >= 0.09995 ? 3 : 4;
  return with_minus(fmt::format("{:.{}f}", value, size < 0.009995 ? 5 : decimals));
}

std::string count_html(std::int64_t value) {
  std::string digits = std::to_string(value);
  const size_t first = value < 0 ? 1 : 0;
  for (size_t i = digits.size(); i > first + 3;) {
    i -= 3;
    digits.insert(i, "\u202f");
  }
  return with_minus(digits);
}

std::string script_safe(std::string_view script) {
  std::string result;
  result.reserve(script.size() + 16);
  for (size_t i = 0; i < script.size(); ++i) {
    const std::string_view rest = script.substr(i);
    result += script[i];
    if (starts_ignoring_case(rest, "</script") || rest.starts_with("<!--")) result += '\\';
  }
  return result;
}

std::string json_safe(std::string_view json) {
  std::string result;
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace diptych::report
