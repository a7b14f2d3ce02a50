#pragma once
/// What a solver is made of that neither the case says nor its nodes: rank 0 works it out, the
/// others are given it. Test: tests/ranks

#include "common/parallel/sharing.hpp"
#include "common/scheme/body/body.hpp"

namespace diptych::run {

struct RankSetUp {
  scheme::BodyOptions body;
  double cfl = 0;
  double geometric_rate = 0;  ///< 1/m, scheme::geometric_rate
};

}  // namespace diptych::run
