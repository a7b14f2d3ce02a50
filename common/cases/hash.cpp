#include "common/cases/reader.hpp"

#include <cstdint>
#include <fmt/format.h>
#include <set>

namespace diptych::cases {

std::string case_hash(const std::string& text, const std::vector<std::string>& overrides) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a, 64 bits
  const auto add = [&hash](const std::string& part) {
    for (const char c : part + '\0')
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  };
  add(text);
  for (const std::string& assignment : std::set<std::string>(overrides.begin(), overrides.end()))
    add(assignment);
  return fmt::format("{:016x}", hash);
}

}  // namespace diptych::cases
