#pragma once
/// Levels of a study that are one level. Test: tests/harness/refinement_test.cpp

#include "common/cases/case.hpp"
#include "common/io/run_record.hpp"

namespace diptych::harness {

/// @param coarse, fine  of one column on two levels, one after the other
/// @throws base::InputError where they have as many nodes: a .geo file that does not heed the size
///         that it is given
void require_refined(const cases::Case& setup,
                     const io::RunSummary& coarse,
                     const io::RunSummary& fine);

}  // namespace diptych::harness
