#pragma once
/// Reads back what the page has in base64.

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::test {

inline std::vector<std::uint8_t> decoded(const std::string& base64) {
  static const std::string letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    group = (group << 6) | static_cast<std::uint32_t>(letters.find(c));
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(group >> bits));
  }
  return bytes;
}

/// Numbers of 16 bits, low byte first, as the page reads them.
inline std::vector<int> words(const std::string& base64) {
  const std::vector<std::uint8_t> bytes = decoded(base64);
  std::vector<int> result;
  for (size_t i = 0; i + 1 < bytes.size(); i += 2)
    result.push_back(bytes[i] + 256 * bytes[i + 1]);
  return result;
}

}  // namespace diptych::test
