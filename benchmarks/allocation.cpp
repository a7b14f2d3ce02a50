/// Memory of the program's containers: arrays of megabytes ask for huge pages, whoever makes them.
/// A graph of a million nodes is built in gigabytes that are written once; small pages then cost
/// more than what is written to them (whole runs of half a million nodes took 1.8 times as long).

#include <cstddef>
#include <cstdlib>
#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

void* allocate(std::size_t n) {
#if defined(__linux__)
  if (n >= 2 * huge_page) {
    const std::size_t bytes = (n + huge_page - 1) / huge_page * huge_page;
    void* memory = bytes < n ? nullptr : std::aligned_alloc(huge_page, bytes);
    if (memory != nullptr) madvise(memory, bytes, MADV_HUGEPAGE);  // refusing it costs only time
    return memory;
  }
#endif
  return std::malloc(n == 0 ? 1 : n);
}

}  // namespace

void* operator new(std::size_t n) {
  for (;;) {
    if (void* memory = allocate(n)) return memory;
    const std::new_handler make_room = std::get_new_handler();
    if (make_room == nullptr) throw std::bad_alloc();
    make_room();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
