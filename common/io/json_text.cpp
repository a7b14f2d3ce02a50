#include "common/io/json_text.hpp"

#include "common/base/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <vector>

namespace diptych::io {

namespace {

using Json = nlohmann::ordered_json;

/// JSON allows a key twice and the library keeps the last; a record must mean one thing.
class DuplicateKeys {
 public:
  explicit DuplicateKeys(const std::string& path) : path_(path) {}

  bool operator()(int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key &&
        !open_.back().insert(parsed.get<std::string>()).second) {
      throw base::InputError(
          fmt::format("{}: key '{}' stands twice; remove one", path_, parsed.get<std::string>()));
    }
    return true;
  }

 private:
  const std::string& path_;
  std::vector<std::set<std::string>> open_;
};

/// "path:line:column" of a byte of the text (1-based, as the parser counts).
std::string place(const std::string& text, const std::string& path, size_t byte) {
  const size_t end = std::min(text.size(), byte > 0 ? byte - 1 : 0);
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const size_t newline = end > 0 ? text.rfind('\n', end - 1) : std::string::npos;
  const size_t column = newline == std::string::npos ? end + 1 : end - newline;
  return fmt::format("{}:{}:{}", path, line, column);
}

/// The library's "[json.exception...] ..." without its prefix.
std::string parser_reason(const std::string& what) {
  const size_t bracket = what.find("] ");
  return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

}  // namespace

nlohmann::ordered_json parsed_json(const std::string& text, const std::string& path) {
  DuplicateKeys duplicates(path);
  try {
    return Json::parse(text, [&](int depth, Json::parse_event_t event, Json& value) {
      return duplicates(depth, event, value);
    });
  } catch (const Json::parse_error& error) {
    throw base::InputError(fmt::format("{}: not valid JSON: {}", place(text, path, error.byte),
                                       parser_reason(error.what())));
  } catch (const Json::exception& error) {
    throw base::InputError(fmt::format("{}: {}", path, parser_reason(error.what())));
  }
}

}  // namespace diptych::io
