#include "common/cases/variant.hpp"

#include "common/base/error.hpp"
#include "common/cases/document.hpp"
#include "common/cases/keys.hpp"
#include "common/cases/settings.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace diptych::cases {

namespace {

constexpr size_t longest_name = 60;
constexpr const char* letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._=+-";

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Whether a word is the beginning of a setting: "section.key=...".
bool begins_a_setting(const std::string& word) {
  const size_t equals = word.find('='), point = word.find('.');
  return equals != word.npos && point < equals;
}

/// "sph.kappa=1.2 sph.gradient=sbp; time.cfl = 0.5" as three settings; blanks within a value stay.
std::vector<std::string> settings_of(const std::string& text) {
  std::vector<std::string> settings;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) {
    bool is_first = true;
    std::istringstream words(part);
    for (std::string word; words >> word; is_first = false) {
      if (is_first || begins_a_setting(word)) {
        settings.push_back(word);
      } else {
        settings.back() += " " + word;
      }
    }
  }
  return settings;
}

/// "kappa=0.75+gradient=sbp" of the settings, in the letters of a name.
std::string name_of(const std::vector<std::string>& settings) {
  std::string name;
  for (const std::string& setting : settings) {
    const size_t point = setting.substr(0, setting.find('=')).rfind('.');
    if (!name.empty()) name += '+';
    for (const char c : setting.substr(point == setting.npos ? 0 : point + 1)) {
      if (c != ' ' && c != '"') name += std::string(letters).find(c) == std::string::npos ? '_' : c;
    }
  }
  return name.substr(0, longest_name);
}

[[noreturn]] void fail(const VariantCase& variant, const std::string& reason) {
  throw base::InputError(fmt::format("{}variant '{}' {}", functions::prefix(variant.where),
                                     shown(variant.name), reason));
}

void check_name(const VariantCase& variant) {
  const std::string& name = variant.name;
  const bool is_fit =
      !name.empty() && name.size() <= longest_name && name.find_first_not_of(letters) == name.npos;
  if (!is_fit) {
    fail(variant, fmt::format("gives its folder the name: use letters, digits and . _ = + -, {} at "
                              "most",
                              longest_name));
  }
}

/// The methods whose own sections the settings name, in order.
std::set<std::string> methods_named(const VariantCase& variant) {
  std::set<std::string> methods;
  for (const std::string& setting : variant.set) {
    if (setting.find('=') == setting.npos || setting.front() == '=')
      fail(variant,
           fmt::format("sets '{}'; write key=value, as in sph.kappa=0.75", shown(setting)));
    const std::string key = table_path(key_of(setting));
    if (find_key(key) == nullptr) {
      fail(variant,
           fmt::format("sets an unknown key '{}'{}", shown(key_of(setting)), key_suggestion(key)));
    }
    for (const char* other : {"record.", "variant.", "expect."}) {
      if (key.starts_with(other))
        fail(variant, fmt::format("sets '{}', which no run reads", shown(key)));
    }
    for (const char* method : {"sph", "fvm"}) {
      if (key.starts_with(std::string(method) + ".")) methods.insert(method);
    }
  }
  return methods;
}

/// Checks the settings against each other. @return the method that they make the variant's
std::string method_of(const VariantCase& variant) {
  if (variant.set.empty()) fail(variant, "sets nothing; give it key=value, as in sph.kappa=0.75");
  const std::set<std::string> named = methods_named(variant);
  if (named.size() > 1) {
    fail(variant,
         "sets keys of sph and of fvm, but a column is of one method; make two variants of it");
  }
  if (named.empty()) return variant.method;
  if (!variant.method.empty() && variant.method != *named.begin()) {
    fail(variant, fmt::format("of {} sets keys of {}, which it does not read", variant.method,
                              *named.begin()));
  }
  return *named.begin();
}

/// Whether both have a column of the same method.
bool share_a_method(const VariantCase& a, const VariantCase& b) {
  return a.method.empty() || b.method.empty() || a.method == b.method;
}

}  // namespace

VariantCase variant_from_text(const std::string& text) {
  VariantCase variant;
  variant.where = {"--with " + shown(text), 0, 0};
  const size_t colon = text.find(':');
  const bool is_named = colon != text.npos && text.find('=') > colon;
  variant.set = settings_of(is_named ? text.substr(colon + 1) : text);
  variant.name = is_named ? trimmed(text.substr(0, colon)) : name_of(variant.set);
  return variant;
}

void add_variant(VariantCase variant, std::vector<VariantCase>& variants) {
  variant.method = method_of(variant);
  check_name(variant);
  for (const VariantCase& other : variants) {
    if (other.name == variant.name && share_a_method(variant, other))
      fail(variant, "is there already; give it another name");
  }
  variants.push_back(std::move(variant));
}

std::string setting_in_common(const VariantCase& variant, const Case& setup, const Case& changed) {
  const auto own = lasting_settings(setup), others = lasting_settings(changed);
  for (const std::string& setting : variant.set) {
    const std::string key = key_of(setting);
    const auto here = own.find(key), there = others.find(key);
    if (there == others.end()) continue;
    const std::string value = here != own.end() ? here->second : key_at(table_path(key)).standard;
    if (value == there->second) return key + " = " + value;
  }
  return "";
}

}  // namespace diptych::cases
