#include "common/io/run_record.hpp"

#include <nlohmann/json.hpp>

namespace diptych::io {

std::optional<SummaryOwner> summary_owner(const std::string& text) {
  const nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  const auto word = [&](const char* key) {
    const auto found = root.find(key);
    return found != root.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (!root.is_object() || word("case").empty() || word("method").empty()) return std::nullopt;
  return SummaryOwner{word("case"), word("case_file"),
                      column_name(word("method"), word("variant"))};
}

}  // namespace diptych::io
