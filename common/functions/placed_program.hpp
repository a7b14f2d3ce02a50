#pragma once
/// Results of a program at given places, for one instant after the other: what depends on the place
/// alone is worked out when the places are given and kept, what depends on time alone once per
/// instant, the rest for eight places at a time. Places stand in blocks of eight, blocks in strips,
/// which threads evaluate independently of one another; a value does not depend on its neighbours.
/// Test: tests/common/functions/program_test.cpp

#include "common/algebra/lanes.hpp"
#include "common/functions/program.hpp"
#include "common/parallel/for_chunks.hpp"

#include <span>
#include <vector>

namespace diptych::functions {

using algebra::Lanes;

/// Values in a block. Aligned for every instruction set: baseline code by itself would align Lanes
/// to 16 bytes only.
struct alignas(sizeof(Lanes)) LaneBlock {
  Lanes v;
};

class PlacedProgram {
 public:
  /// Values at one instant of what depends on time alone, and constants: each in all lanes.
  using Instant = std::vector<LaneBlock>;
  /// Of one thread; made by workspace().
  struct Workspace {
    std::vector<LaneBlock> registers;  ///< [register][block]
    std::vector<double> given;
  };
  /// A result in the blocks of a strip.
  struct Blocks {
    const LaneBlock* first;
    int stride;  ///< 0 where it is the same in all
    DIPTYCH_INLINE const Lanes& operator[](int block) const { return first[block * stride].v; }
  };

  /// @param results  places in the program
  /// @param X        m
  PlacedProgram(std::shared_ptr<const Program> program,
                const std::vector<int>& results,
                std::span<const Vec3> X);

  /// Moves to as many other places.
  void move_to(std::span<const Vec3> X);

  std::int64_t n_places() const { return static_cast<std::int64_t>(X_.size()); }
  const Vec3& X(std::int64_t place) const { return X_[static_cast<size_t>(place)]; }
  std::int64_t n_strips() const { return n_strips_; }
  /// Blocks of a strip; the last strip is filled up with the last place.
  int width() const { return width_; }
  static constexpr int widest = 8;

  Instant at(double t) const;
  Workspace workspace() const;
  /// Evaluates a strip; results are then there until the workspace is used again.
  void evaluate(std::int64_t strip, double t, const Instant& instant, Workspace& workspace) const;
  /// Calls work(strip, workspace) for all strips, by all threads.
  template <class Work>
  void for_strips(const Work& work) const {
    for_strips(0, n_strips_, work);
  }
  /// The same for strips [begin, end).
  template <class Work>
  void for_strips(std::int64_t begin, std::int64_t end, const Work& work) const {
    constexpr std::int64_t together = 4;
    parallel::for_shares((end - begin + together - 1) / together, [&](std::int64_t share) {
      Workspace space = workspace();
      const std::int64_t first = begin + share * together;
      for (std::int64_t strip = first; strip < std::min(end, first + together); ++strip)
        work(strip, space);
    });
  }
  Blocks result(int k,
                std::int64_t strip,
                const Instant& instant,
                const Workspace& workspace) const {
    return blocks(results_[static_cast<size_t>(k)], strip, instant.data(),
                  workspace.registers.data());
  }

 private:
  enum class Kept : std::uint8_t { registers, table, scalars };
  struct Operand {
    Kept in = Kept::scalars;
    int at = 0;
  };
  /// A product whose only reader is a sum is worked out with it: p*q + c, p*q - c, c - p*q.
  enum class Fusion : std::uint8_t { none, plus, minus, reversed_minus };
  struct Instruction {
    Operation operation;  ///< the product, where it is fused
    Operand arguments[3];
    int to = 0;     ///< register
    int also = -1;  ///< register of the cosine, beside the sine
    Fusion fusion = Fusion::none;
  };
  /// A function of the case that depends on the place: all its values that are asked for.
  struct GivenCall {
    int function = 0, n_names = 0;
    std::vector<std::pair<int, int>> names;  ///< and the registers of their values
  };

  void compile(const std::vector<int>& results);
  std::vector<char> needed(const std::vector<int>& results) const;
  void place_scalars(const std::vector<char>& is_needed);
  void place_table(const std::vector<char>& is_needed, const std::vector<int>& results);
  void place_registers(const std::vector<char>& is_needed, const std::vector<int>& results);
  Instruction instruction_of(int k, const std::vector<Operand>& where) const;
  std::vector<int> fused_products(const std::vector<char>& is_needed,
                                  const std::vector<int>& results) const;
  Instruction fused_instruction(int k, int product) const;
  void tabulate();
  DIPTYCH_CLONES void run(const Instruction& instruction,
                          std::int64_t strip,
                          const LaneBlock* scalars,
                          LaneBlock* registers) const;
  DIPTYCH_INLINE Blocks blocks(const Operand& operand,
                               std::int64_t strip,
                               const LaneBlock* scalars,
                               const LaneBlock* registers) const {
    switch (operand.in) {
      case Kept::registers:
        return {registers + operand.at * width_, 1};
      case Kept::table:
        return {table_.data() + (strip * n_table_ + operand.at) * width_, 1};
      case Kept::scalars:
        break;
    }
    return {scalars + operand.at, 0};
  }
  void call(const GivenCall& given, std::int64_t strip, double t, Workspace& workspace) const;

  std::shared_ptr<const Program> program_;
  std::vector<Vec3> X_;
  int width_;
  std::int64_t n_strips_;
  std::vector<Operand> where_;  ///< [operations], of those that are needed
  std::vector<Operand> results_;
  std::vector<int> scalars_;  ///< operations, ascending: constants and those of time
  Instant constants_;         ///< [scalars_]; of those of time nothing yet
  std::vector<Instruction> of_place_, mixed_;
  std::vector<Operand> kept_;  ///< [n_table] registers of of_place_
  std::vector<GivenCall> calls_;
  int n_place_registers_ = 3, n_registers_ = 0, n_table_ = 0;
  std::vector<LaneBlock> table_;  ///< [strip][n_table][block]
};

}  // namespace diptych::functions
