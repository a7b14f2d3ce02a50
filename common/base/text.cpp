#include "common/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>

namespace diptych::base {

namespace {
char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}
}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1, 0));
  for (size_t i = 0; i <= n; ++i)
    d[i][0] = static_cast<int>(i);
  for (size_t j = 0; j <= m; ++j)
    d[0][j] = static_cast<int>(j);
  for (size_t i = 1; i <= n; ++i) {
    for (size_t j = 1; j <= m; ++j) {
      const int cost = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[n][m];
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  std::string nearest;
  int least = static_cast<int>(word.size()) / 2 + 1;
  for (const auto& name : names) {
    // The distance is at least the difference of the lengths: a long word is not compared at all.
    const auto apart =
        static_cast<std::ptrdiff_t>(word.size()) - static_cast<std::ptrdiff_t>(name.size());
    if (std::abs(apart) >= least) continue;
    const int distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  if (!nearest.empty()) return "; did you mean '" + nearest + "'?";
  return "; known: " + joined(names);
}

std::string joined(const std::vector<std::string>& names, std::string_view separator) {
  std::string text;
  for (const auto& name : names) {
    if (!text.empty()) text += separator;
    text += name;
  }
  return text;
}

std::string folded(std::string_view text, size_t indent, size_t width) {
  std::string all;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string line(text.substr(0, end));
    while (line.size() > width) {
      const size_t first = std::max(line.find_first_not_of(' '), indent);
      size_t at = line.rfind(' ', width);
      if (at == std::string::npos || at <= first) at = line.find(' ', width);
      if (at == std::string::npos) break;
      all += line.substr(0, line.find_last_not_of(' ', at) + 1) + "\n";
      const size_t next = line.find_first_not_of(' ', at);
      line = next == std::string::npos ? "" : std::string(indent, ' ') + line.substr(next);
    }
    all += line;
    if (end < text.size()) all += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

}  // namespace diptych::base
