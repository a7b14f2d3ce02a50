#pragma once
/// Frames that two runs have left.

#include "common/io/field_writer.hpp"
#include "tests/command_line/program.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace diptych::tests {

inline void expect_same_frames(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto wanted = io::read_series((a / "run.hdf.series").string());
  const auto found = io::read_series((b / "run.hdf.series").string());
  ASSERT_EQ(found.size(), wanted.size());
  for (size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_EQ(found[k].time, wanted[k].time);
    for (const char* field : {"velocity [m/s]", "displacement [m]", "first_piola_stress [Pa]"}) {
      EXPECT_EQ(io::read_field(found[k].path, field).values,
                io::read_field(wanted[k].path, field).values)
          << field << " of frame " << k;
    }
    EXPECT_TRUE(text_of(found[k].path) == text_of(wanted[k].path)) << "bytes of frame " << k;
  }
}

}  // namespace diptych::tests
