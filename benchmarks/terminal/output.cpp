#include "benchmarks/terminal/output.hpp"

#include "common/io/atomic_file.hpp"
#include "common/io/run_record.hpp"

#include <cstdio>
#include <filesystem>

namespace diptych::harness {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void write_output(const std::string& folder, const std::string& name, const std::string& text) {
  io::make_directory(folder);
  const std::string file = (std::filesystem::path(folder) / name).string();
  io::write_file_atomically(file, text);
  print("output: " + file + "\n");
}

}  // namespace diptych::harness
