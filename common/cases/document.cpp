/// The only file that includes toml++.

#include "common/cases/document.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/cases/toml_depth.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <toml++/toml.h>
#include <utility>

namespace diptych::cases {

namespace {

constexpr size_t max_bytes = size_t{1} << 20;

functions::SourcePlace place_of(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

/// Where each line of a text begins: looked for once, not for every value.
std::vector<size_t> line_begins(const std::string& source) {
  std::vector<size_t> begins{source.rfind("\xEF\xBB\xBF", 0) == 0 ? size_t{3} : size_t{0}};
  for (size_t at = source.find('\n'); at != std::string::npos; at = source.find('\n', at + 1))
    begins.push_back(at + 1);
  return begins;
}

/// Byte of a place (columns count code points), or npos where the text ends before.
size_t byte_of(const std::string& source,
               const std::vector<size_t>& lines,
               const functions::SourcePlace& where) {
  const auto line = static_cast<size_t>(where.line);
  if (line < 1 || line > lines.size()) return std::string::npos;
  size_t at = lines[line - 1];
  for (int column = 1; column < where.column && at < source.size(); ++column) {
    ++at;
    while (at < source.size() && (static_cast<unsigned char>(source[at]) & 0xC0) == 0x80)
      ++at;
  }
  return at;
}

/// Place of the first character of a string's text; column 0 where escapes hide it.
functions::SourcePlace place_of_text(const std::string& source,
                                     const std::vector<size_t>& lines,
                                     functions::SourcePlace where,
                                     const std::string& text) {
  const functions::SourcePlace unknown{where.file, where.line, 0};
  size_t at = byte_of(source, lines, where);
  if (at >= source.size()) return unknown;
  const std::string quotes(3, source[at]);
  if (source.compare(at, 3, quotes) == 0) {
    at += 3;
    where.column += 3;
    if (source.compare(at, 2, "\r\n") == 0) ++at;
    if (source.compare(at, 1, "\n") == 0) {
      ++at;
      ++where.line;
      where.column = 1;
    }
  } else {
    at += 1;
    where.column += 1;
  }
  return source.compare(at, text.size(), text) == 0 ? where : unknown;
}

/// TOML nodes to values.
class Conversion {
 public:
  Conversion(const std::string& source, std::string file)
      : source_(source), lines_(line_begins(source)), file_(std::move(file)) {}

  Value value(const toml::node& node) const {
    Value v;
    v.where = place_of(node.source(), file_);
    if (const auto* table = node.as_table()) {
      v.kind = Value::Kind::table;
      v.members = members(*table);
    } else if (const auto* list = node.as_array()) {
      v.kind = Value::Kind::list;
      for (const toml::node& element : *list)
        v.elements.push_back(value(element));
    } else if (const auto* text = node.as_string()) {
      v.kind = Value::Kind::text;
      v.text = text->get();
      v.text_where = place_of_text(source_, lines_, v.where, v.text);
    } else if (const auto* integer = node.as_integer()) {
      v.kind = Value::Kind::integer;
      v.integer = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
      v.kind = Value::Kind::real;
      v.real = real->get();
      if (!std::isfinite(v.real)) {
        throw base::InputError(
            fmt::format("{}{} is not a finite number", functions::prefix(v.where), v.real));
      }
    } else if (const auto* flag = node.as_boolean()) {
      v.kind = Value::Kind::flag;
      v.flag = flag->get();
    } else {
      v.kind = Value::Kind::date;
    }
    return v;
  }

 private:
  std::vector<Member> members(const toml::table& table) const {
    std::vector<Member> all;
    for (const auto& [key, node] : table)
      all.push_back({std::string(key.str()), place_of(key.source(), file_), value(node)});
    // toml++ sorts by name; parameters need the order of the file.
    std::stable_sort(all.begin(), all.end(), [](const Member& a, const Member& b) {
      return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
    });
    return all;
  }

  const std::string& source_;
  std::vector<size_t> lines_;
  std::string file_;
};

void set_places(Value& value, const functions::SourcePlace& where) {
  value.where = value.text_where = where;
  for (Value& element : value.elements)
    set_places(element, where);
  for (Member& member : value.members) {
    member.where = where;
    set_places(member.value, where);
  }
}

/// The right side of key=value: TOML where it is TOML, else plain text.
Value assigned_value(const std::string& text, const functions::SourcePlace& where) {
  const std::string line = "value = " + text;
  const bool is_one_line =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7F; });
  if (!is_one_line)
    throw base::InputError(functions::prefix(where) + "the value holds control characters");
  check_depth(line, where.file);
  Value value;
  try {
    const toml::table table = toml::parse(std::string_view(line));
    value = Conversion(line, where.file).value(*table.get("value"));
  } catch (const toml::parse_error&) {
    value.kind = Value::Kind::text;
    value.text = text;
  } catch (const base::InputError&) {
    throw base::InputError(functions::prefix(where) + "the value is not a finite number");
  }
  set_places(value, where);
  return value;
}

std::vector<std::string> steps_of(const std::string& key) {
  std::vector<std::string> steps(1);
  for (const char c : key) {
    if (c == '.') {
      steps.emplace_back();
    } else {
      steps.back() += c;
    }
  }
  return steps;
}

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

Value& entry_of(Value& list, const std::string& step, const functions::SourcePlace& where) {
  const bool is_index =
      !step.empty() && step.size() < 10 &&
      std::all_of(step.begin(), step.end(), [](char c) { return c >= '0' && c <= '9'; });
  const size_t index = is_index ? std::stoul(step) : list.elements.size();
  if (index >= list.elements.size()) {
    throw base::InputError(
        fmt::format("{}'{}' is no entry of this list; it has {}, counted from 0 (section.0.key)",
                    functions::prefix(where), shown(step), list.elements.size()));
  }
  return list.elements[index];
}

std::string capital_to_lower(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z')
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

}  // namespace

const Member* Value::find(const std::string& name) const {
  for (const Member& member : members) {
    if (member.name == name) return &member;
  }
  return nullptr;
}

Member* Value::find(const std::string& name) {
  return const_cast<Member*>(std::as_const(*this).find(name));
}

std::string shown(const std::string& text) {
  std::string fit = text.size() > 60 ? text.substr(0, 57) + "..." : text;
  for (char& c : fit) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return fit;
}

std::string described(const Value& value) {
  switch (value.kind) {
    case Value::Kind::flag:
      return value.flag ? "true" : "false";
    case Value::Kind::integer:
      return fmt::format("the number {}", value.integer);
    case Value::Kind::real:
      return fmt::format("the number {}", value.real);
    case Value::Kind::text:
      return fmt::format("the text '{}'", shown(value.text));
    case Value::Kind::list:
      return fmt::format("a list of {}", value.elements.size());
    case Value::Kind::table:
      return "a table";
    case Value::Kind::date:
      break;
  }
  return "a date or time";
}

Value parse_document(const std::string& text, const std::string& file) {
  if (text.size() > max_bytes) {
    throw base::InputError(
        fmt::format("{}: {} bytes; a case file has at most {}", file, text.size(), max_bytes));
  }
  check_depth(text, file);
  try {
    const toml::table table = toml::parse(std::string_view(text));
    Value document = Conversion(text, file).value(table);
    document.where = {file, 1, 1};
    return document;
  } catch (const toml::parse_error& error) {
    throw base::InputError(
        functions::prefix(place_of(error.source(), file)) +
        "this is not TOML: " + capital_to_lower(std::string(error.description())));
  }
}

bool are_of_one_value(const std::string& key, const std::string& other) {
  return key == other || key.starts_with(other + ".") || other.starts_with(key + ".");
}

std::string key_of(const std::string& assignment) {
  const size_t equals = assignment.find('=');
  const std::string key = equals == std::string::npos ? "" : trimmed(assignment.substr(0, equals));
  if (key.empty()) {
    throw base::InputError("--set " + shown(assignment) +
                           ": write --set key=value, as in --set mesh.element=tetrahedron");
  }
  return key;
}

void override_value(Value& document, const std::string& assignment) {
  const std::vector<std::string> steps = steps_of(key_of(assignment));
  const functions::SourcePlace where{"--set " + shown(assignment), 0, 0};
  const Value value = assigned_value(trimmed(assignment.substr(assignment.find('=') + 1)), where);

  Value* at = &document;
  for (const std::string& step : steps) {
    if (at->kind == Value::Kind::list) {
      at = &entry_of(*at, step, where);
    } else if (at->kind == Value::Kind::table) {
      if (at->find(step) == nullptr) {
        at->members.push_back({step, where, {}});
        at->members.back().value.where = where;
      }
      at = &at->find(step)->value;
    } else {
      throw base::InputError(fmt::format("{}'{}' stands below {}, which has no parts",
                                         functions::prefix(where), shown(step), described(*at)));
    }
  }
  *at = value;
}

}  // namespace diptych::cases
