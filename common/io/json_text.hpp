#pragma once
/// JSON with a place in each complaint. Test: tests/common/io/run_record_test.cpp

#include <nlohmann/json.hpp>
#include <string>

namespace diptych::io {

/// @param path  stands in messages
/// @throws base::InputError with path:line:column on broken text, a key that stands twice
nlohmann::ordered_json parsed_json(const std::string& text, const std::string& path);

}  // namespace diptych::io
