#include "common/parallel/pages.hpp"

#include "common/algebra/field.hpp"
#include "common/base/error.hpp"

#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <malloc.h>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace diptych::parallel {

namespace {

std::uintptr_t page_bytes() {
  static const auto bytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

bool is_poisoned() {
  static const bool poisoned = [] {
    const char* asked = std::getenv("DIPTYCH_RANK_MEMORY");
    if (asked == nullptr || *asked == '\0') return false;
    if (std::string_view(asked) == "poisoned") return true;
    throw base::InputError(
        fmt::format("DIPTYCH_RANK_MEMORY={}: the only value is \"poisoned\"; or unset it", asked));
  }();
  return poisoned;
}

/// Tells the system what is wanted with the pages of this size that lie wholly inside. It may
/// refuse: that costs memory only.
void advise_inside(std::uintptr_t begin, std::uintptr_t end, std::uintptr_t page, int advice) {
  const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, advice);
}

/// The same of the pages that hold an end of it and something else.
void advise_at_ends(std::uintptr_t begin, std::uintptr_t end, std::uintptr_t page, int advice) {
  const std::uintptr_t first = begin / page * page, last = end / page * page;
  if (begin > first) madvise(reinterpret_cast<void*>(first), page, advice);
  if (end > last && (last != first || begin == first))
    madvise(reinterpret_cast<void*>(last), page, advice);
}

}  // namespace

void give_back(std::byte* begin, std::int64_t n) {
  if (n <= 0) return;
  if (is_poisoned()) {
    std::memset(begin, 0xff, static_cast<size_t>(n));
  } else {
    const auto first = reinterpret_cast<std::uintptr_t>(begin),
               last = first + static_cast<std::uintptr_t>(n);
    advise_at_ends(first, last, algebra::huge_page, MADV_NOHUGEPAGE);
    advise_inside(first, last, page_bytes(), MADV_DONTNEED);
  }
}

std::int64_t status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) == 0) return std::stoll(line.substr(key.size())) * 1024;
  }
  return 0;
}

std::int64_t settled_bytes() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::int64_t>(page_bytes());
}

}  // namespace diptych::parallel
