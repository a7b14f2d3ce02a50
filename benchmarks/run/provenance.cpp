#include "benchmarks/run/provenance.hpp"

#include "common/algebra/lanes.hpp"
#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "common/io/run_record.hpp"

#include <cstdint>
#include <ctime>
#include <elf.h>
#include <fmt/format.h>
#include <fstream>
#include <link.h>
#include <string>
#include <string_view>

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

/// What the linker wrote into the program to tell it from every other; empty where it did not.
std::string build_id() {
  std::string id;
  const auto take = [](dl_phdr_info* info, size_t, void* result) {
    for (int k = 0; k < info->dlpi_phnum; ++k) {
      const ElfW(Phdr)& header = info->dlpi_phdr[k];
      if (header.p_type != PT_NOTE) continue;
      const auto* at = reinterpret_cast<const char*>(info->dlpi_addr + header.p_vaddr);
      const char* const end = at + header.p_memsz;
      while (at + sizeof(ElfW(Nhdr)) <= end) {
        const auto& note = *reinterpret_cast<const ElfW(Nhdr)*>(at);
        const char* const name = at + sizeof note;
        const char* const content = name + (note.n_namesz + 3) / 4 * 4;
        if (note.n_type == NT_GNU_BUILD_ID && std::string_view(name, 3) == "GNU") {
          for (std::uint32_t i = 0; i < note.n_descsz; ++i)
            *static_cast<std::string*>(result) +=
                fmt::format("{:02x}", static_cast<unsigned char>(content[i]));
        }
        at = content + (note.n_descsz + 3) / 4 * 4;
      }
    }
    return 1;  // the program itself comes first: no further
  };
  dl_iterate_phdr(take, &id);
  return id.substr(0, 16);
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
  static const std::string hash = [] {
    const std::string id = build_id();
    return id.empty() ? file_hash("/proc/self/exe")
                      : id;  // reading 18 MB takes as long as a small run
  }();
  return hash;
}

}  // namespace diptych::harness
