#pragma once
/// Whether what a case says of its initial state fits together. F and u are integrated side by
/// side, so a body that begins with an F that is not I + du/dX keeps the difference for good: the
/// stress of one motion at the places of another. Test: tests/common/run/initial_state_test.cpp

#include "common/cases/case.hpp"
#include "common/scheme/graph/pair_graph.hpp"

namespace diptych::run {

/// Compares a given F with difference quotients of the displacement, column by column, between each
/// node and its neighbours: in their mean, which is inside the body, with steps of a thousandth of
/// their distance. One of the central, forward and backward quotients must agree to 1e-3 of the
/// largest |F - I|, and rounding, so that kinks may lie anywhere. Of bodies of more than 50 000
/// nodes it takes so many, evenly spread. Nothing is compared where F is not given: it is then the
/// discrete gradient.
/// @throws base::InputError where they are apart: place and both columns
void check_initial_deformation(const cases::Case& setup, const scheme::PairGraph& graph);

}  // namespace diptych::run
