/// Storage of tensors by dimension, and of nodal fields in blocks of eight.

#include "common/algebra/layout.hpp"

#include "common/algebra/node_table.hpp"

#include <gtest/gtest.h>

namespace {

using namespace diptych::algebra;

/// Of a block whose component k holds 100 k + lane, so that every slot is told apart.
BlockField numbered(int n, bool single) {
  BlockField field(n_lanes, n, single);
  for (int k = 0; k < n; ++k) {
    for (int lane = 0; lane < n_lanes; ++lane)
      field.set(lane, k, 100 * k + lane);
  }
  return field;
}

/// get, then put: every stored component comes back to its own slot.
template <class Get, class Put>
void expect_round_trip(int n, Get get, Put put) {
  for (const bool single : {false, true}) {
    const BlockField field = numbered(n, single);
    BlockField back(n_lanes, n, single);
    put(back, get(field));
    for (int k = 0; k < n; ++k) {
      for (int lane = 0; lane < n_lanes; ++lane)
        EXPECT_EQ(back.at(lane, k), field.at(lane, k));
    }
  }
}

template <int Dim>
void expect_all_round_trips() {
  using Sizes = Layout<Dim>;
  expect_round_trip(
      Sizes::n_F, [](const auto& f) { return get_tensor<Dim>(f, 0, 0, 1); },
      [](auto& f, const auto& F) { put_tensor<Dim>(f, 0, 0, F, 1); });
  expect_round_trip(
      Sizes::n_A, [](const auto& f) { return get_A<Dim>(f, 0, 0); },
      [](auto& f, const auto& A) { put_A<Dim>(f, 0, 0, A); });
  expect_round_trip(
      Sizes::n_S, [](const auto& f) { return get_S<Dim>(f, 0, 0); },
      [](auto& f, const auto& S) { put_S<Dim>(f, 0, 0, S); });
}

TEST(Layout, StoresAndLoadsEveryComponentInItsSlot) {
  expect_all_round_trips<2>();
  expect_all_round_trips<3>();
}

TEST(Layout, PlaneStrainKeepsWhatChangesAndPutsInTheConstants) {
  const BlockField field = numbered(6, false);
  const auto F = get_tensor<2>(field, 0, 0, 1);
  EXPECT_EQ(F(0, 0)[3], 4);  // the deviation from I is stored
  EXPECT_EQ(F(0, 1)[3], 103);
  EXPECT_EQ(F(1, 0)[3], 203);
  EXPECT_EQ(F(1, 1)[3], 304);
  EXPECT_EQ(F(2, 2)[3], 1);
  EXPECT_EQ(F(0, 2)[3], 0);
  EXPECT_EQ(F(2, 1)[3], 0);
  EXPECT_EQ(get_tensor<2>(field, 0, 0)(2, 2)[3], 0);
  const auto A = get_A<2>(field, 0, 0);
  EXPECT_EQ(A(0, 0)[3], 4);
  EXPECT_EQ(A(0, 1)[3], 203);
  EXPECT_EQ(A(2, 2)[3], 1);                        // stays
  EXPECT_EQ(get_S<2>(field, 0, 0)(2, 2)[3], 304);  // evolves
  EXPECT_EQ(get_S<2>(field, 0, 0)(0, 2)[3], 0);
}

TEST(BlockField, PutsNodeIInLaneIOfBlocksOfEight) {
  for (const bool single : {false, true}) {
    BlockField field(19, 3, single);
    for (int node = 0; node < 19; ++node)
      for (int c = 0; c < 3; ++c)
        field.set(node, c, 10 * node + c);
    const Lanes second = field.get(1, 2);
    for (int i = 0; i < n_lanes; ++i)
      EXPECT_EQ(second[i], 10 * (8 + i) + 2);
    EXPECT_EQ(field.bytes(), 3 * 3 * n_lanes * (single ? 4 : 8));
  }
  EXPECT_EQ(n_blocks_of(19), 3);
  EXPECT_EQ(n_blocks_of(16), 2);
  EXPECT_EQ(n_blocks_of(0), 0);
}

TEST(BlockField, PaddingStartsAsZero) {
  const BlockField field(3, 2);
  for (int k = 0; k < 2; ++k) {
    for (int node = 0; node < n_lanes; ++node)
      EXPECT_EQ(field.at(node, k), 0);
  }
  EXPECT_TRUE(BlockField().empty());
  EXPECT_TRUE(BlockField(0, 4).empty());
}

TEST(NodeTable, HoldsTheSameInBothArrangementsAndPrecisions) {
  for (const Arrangement arrangement : {Arrangement::rows, Arrangement::runs}) {
    for (const bool single : {false, true}) {
      NodeTable table(19, 3, 4, {arrangement, 5, single});
      for (int node = 0; node < 19; ++node)
        for (int c = 0; c < 3; ++c)
          table.set(node, c, 10 * node + c + 0.125);
      table.add(9, 2, 0.5);
      table.put(2, 1, Lanes{} - 7.0);
      EXPECT_EQ(table.get(1, 2)[0], 82.125);
      EXPECT_EQ(table.get(1, 2)[1], 92.625);
      EXPECT_EQ(table.at(18, 1), -7);
      EXPECT_EQ(table.at(18, 2), 182.125);
      EXPECT_EQ(table.is_single(), single);
    }
  }
}

}  // namespace
