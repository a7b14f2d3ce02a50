#include "common/parallel/pages.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <unistd.h>

namespace diptych::parallel {
namespace {

TEST(Pages, GoBackWholeAndLeaveWhatIsBesideThem) {
  const std::int64_t page = sysconf(_SC_PAGESIZE), n = 16384 * page;
  const std::unique_ptr<void, void (*)(void*)> memory(
      std::aligned_alloc(static_cast<size_t>(page), static_cast<size_t>(n)), std::free);
  auto* bytes = static_cast<std::byte*>(memory.get());
  ASSERT_NE(bytes, nullptr);
  std::memset(bytes, 1, static_cast<size_t>(n));
  const std::int64_t before = settled_bytes();
  give_back(bytes + 1, n - 2);  // all but the first and the last page
  EXPECT_LT(settled_bytes(), before - n / 2);
  EXPECT_EQ(bytes[page - 1], std::byte{1});
  EXPECT_EQ(bytes[page], std::byte{0});
  EXPECT_EQ(bytes[n - page], std::byte{1});
}

TEST(Pages, StayWhereNoneIsWhole) {
  const std::int64_t page = sysconf(_SC_PAGESIZE);
  const std::unique_ptr<void, void (*)(void*)> memory(
      std::aligned_alloc(static_cast<size_t>(page), static_cast<size_t>(2 * page)), std::free);
  auto* bytes = static_cast<std::byte*>(memory.get());
  ASSERT_NE(bytes, nullptr);
  std::memset(bytes, 1, static_cast<size_t>(2 * page));
  give_back(bytes + 1, 2 * page - 2);
  for (std::int64_t k = 0; k < 2 * page; ++k)
    ASSERT_EQ(bytes[k], std::byte{1}) << k;
}

}  // namespace
}  // namespace diptych::parallel
