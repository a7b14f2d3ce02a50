#include "benchmarks/run/provenance.hpp"

#include "common/algebra/lanes.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/io/run_record.hpp"

#include <ctime>
#include <fstream>
#include <string>

namespace diptych::harness {

namespace {

/// The value of "key : value" in a file of the proc file system.
std::string value_of(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const size_t colon = line.find(':');
    const size_t first = line.find_first_not_of(" \t", colon + 1);
    return first == std::string::npos ? "" : line.substr(first);
  }
  return "unknown";
}

/// What the sweeps run, as levels of the architecture.
std::string instruction_set() {
  using enum algebra::InstructionSet;
  switch (algebra::instruction_set()) {
    case avx512:
      return "x86-64-v4";
    case avx2:
      return "x86-64-v3";
    default:
      return "baseline";
  }
}

/// Piece by piece: a program of 16 MB, read whole, would be most of the memory of a small run.
std::string file_hash(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string hash, piece(1 << 16, '\0');
  do {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash = cases::case_hash(hash + piece.substr(0, static_cast<size_t>(file.gcount())), {});
  } while (file);
  if (!file.eof()) throw base::EnvironmentError(path + ": cannot be read");
  return hash;
}

}  // namespace

io::Provenance provenance(const std::string& case_hash) {
  io::Provenance p;
  p.version = DIPTYCH_VERSION;
  p.commit = DIPTYCH_COMMIT;
  p.compiler = "GCC " __VERSION__;
  p.flags = DIPTYCH_FLAGS;
  p.cpu = value_of("/proc/cpuinfo", "model name");
  p.instruction_set = instruction_set();
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  p.date = date;
  p.case_hash = case_hash;
  p.program = program_hash();
  return p;
}

const std::string& program_hash() {
  static const std::string hash = file_hash("/proc/self/exe");
  return hash;
}

}  // namespace diptych::harness
