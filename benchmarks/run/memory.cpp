#include "benchmarks/run/memory.hpp"

#include "common/parallel/pages.hpp"

#include <algorithm>
#include <fstream>
#include <malloc.h>

namespace diptych::harness {

namespace {

/// What the program itself has allocated; its code, which a first run brings in, is not among it.
std::int64_t allocated_memory() {
  malloc_trim(0);
  return parallel::status_bytes("RssAnon:");
}

template <class Array>
void free_array(Array& array) {
  Array().swap(array);
}

}  // namespace

std::int64_t peak_rss_bytes() {
  return parallel::status_bytes("VmHWM:");
}

RunMemory::RunMemory() {
  static const std::int64_t before_the_first = allocated_memory();
  held_ = std::max<std::int64_t>(0, allocated_memory() - before_the_first);
  reset_peak_rss();
}

void reset_peak_rss() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::int64_t settled_memory() {
  return parallel::settled_bytes();
}

void release_pairs(scheme::PairGraph& graph) {
  graph.slopes = {};
  free_array(graph.row);
  free_array(graph.neighbour);
  free_array(graph.reverse);
  free_array(graph.C);
  graph.classes = {};
  graph.cells = {};
  graph.lines = {};
}

void release_nodes(scheme::PairGraph& graph) {
  free_array(graph.X);
  free_array(graph.Omega);
  free_array(graph.boundary_area);
}

}  // namespace diptych::harness
