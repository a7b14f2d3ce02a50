/// Storage of tensors by dimension, and of nodal fields in blocks of eight.

#include "common/algebra/layout.hpp"

#include "common/algebra/field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace {

using namespace diptych::algebra;

/// A block whose component k holds 100 k + lane, so that every slot is told apart.
template <int n>
std::array<double, static_cast<size_t>(n) * n_lanes> numbered() {
  std::array<double, static_cast<size_t>(n) * n_lanes> block{};
  for (int k = 0; k < n * n_lanes; ++k)
    block[k] = 100 * (k / n_lanes) + k % n_lanes;
  return block;
}

/// load, then store: every stored component comes back to its own slot.
template <int n, class Load, class Store>
void expect_round_trip(Load load_block, Store store_block) {
  const auto block = numbered<n>();
  std::array<double, static_cast<size_t>(n) * n_lanes> back{};
  store_block(back.data(), load_block(block.data()));
  EXPECT_EQ(back, block);
}

template <int Dim>
void expect_all_round_trips() {
  using Sizes = Layout<Dim>;
  expect_round_trip<Sizes::n_F>([](const double* b) { return load_tensor<Dim>(b, 1); },
                                [](double* b, const auto& F) { store_tensor<Dim>(b, F); });
  expect_round_trip<Sizes::n_A>([](const double* b) { return load_A<Dim>(b); },
                                [](double* b, const auto& A) { store_A<Dim>(b, A); });
  expect_round_trip<Sizes::n_S>([](const double* b) { return load_S<Dim>(b); },
                                [](double* b, const auto& S) { store_S<Dim>(b, S); });
}

TEST(Layout, StoresAndLoadsEveryComponentInItsSlot) {
  expect_all_round_trips<2>();
  expect_all_round_trips<3>();
}

TEST(Layout, PlaneStrainKeepsWhatChangesAndPutsInTheConstants) {
  const auto block = numbered<6>();
  const auto F = load_tensor<2>(block.data(), 1);
  EXPECT_EQ(F(0, 1)[3], 103);
  EXPECT_EQ(F(1, 0)[3], 203);
  EXPECT_EQ(F(2, 2)[3], 1);
  EXPECT_EQ(F(0, 2)[3], 0);
  EXPECT_EQ(F(2, 1)[3], 0);
  EXPECT_EQ(load_tensor<2>(block.data(), 0)(2, 2)[3], 0);
  const auto A = load_A<2>(block.data());
  EXPECT_EQ(A(0, 1)[3], 203);
  EXPECT_EQ(A(2, 2)[3], 1);                          // stays
  EXPECT_EQ(load_S<2>(block.data())(2, 2)[3], 303);  // evolves
  EXPECT_EQ(load_S<2>(block.data())(0, 2)[3], 0);
}

TEST(BlockField, PutsNodeIInLaneIOfBlocksOfEight) {
  BlockField field(19, 3);
  for (int node = 0; node < 19; ++node)
    for (int c = 0; c < 3; ++c)
      field.at(node, c) = 10 * node + c;
  const Lanes second = load(field.block(1) + 2 * n_lanes);
  for (int i = 0; i < n_lanes; ++i)
    EXPECT_EQ(second[i], 10 * (8 + i) + 2);
  EXPECT_EQ(n_blocks_of(19), 3);
  EXPECT_EQ(n_blocks_of(16), 2);
  EXPECT_EQ(n_blocks_of(0), 0);
}

TEST(BlockField, PaddingStartsAsZeroAndBlocksAreAligned) {
  const BlockField field(3, 2);
  for (int k = 0; k < 2 * n_lanes; ++k)
    EXPECT_EQ(field.block(0)[k], 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.block(0)) % 64, 0U);
  EXPECT_EQ(field.bytes(), 2 * n_lanes * 8);
  EXPECT_TRUE(BlockField().empty());
  EXPECT_TRUE(BlockField(0, 4).empty());
}

}  // namespace
