/// Checkpoints: the bytes as a file; and a whole file with tables that the bytes choose, of names,
/// kinds, shapes and values that the reader may not expect. HDF5 1.10 itself crashes on content
/// that somebody has damaged and sealed again: the seal is against damage, not against malice, and
/// such files are not tried (common/io/checkpoint_file.hpp).

#include "common/io/checkpoint_file.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace {

using diptych::io::CheckpointReader;
using diptych::io::CheckpointWriter;

constexpr const char* names[] = {"v", "steps", "identity/method", "last step/time"};

/// All kinds of tables under names that a run has.
void read_all(const std::string& path) {
  CheckpointReader reader(path);
  const auto attempt = [](const auto& part) {
    try {
      part();
    } catch (const diptych::base::Error&) {
      // the next one may be there
    }
  };
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  std::string text;
  attempt([&] { reader.reals(names[0], "m/s", reals, 3, 8); });
  if (!reals.empty() && reals.size() != 24) __builtin_trap();
  attempt([&] { reader.integers(names[1], integers, 1); });
  if (!integers.empty() && integers.size() != 1) __builtin_trap();
  attempt([&] { reader.text(names[2], text); });
  reader.finish();
}

/// In memory where there is such a folder: nothing has to reach a disk.
std::string scratch_path() {
  const std::string folder = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  return folder + "/diptych-fuzz-" + std::to_string(::getpid()) + ".hdf";
}

/// Takes numbers from the bytes, zeros behind their end.
class Source {
 public:
  explicit Source(const std::string& bytes) : bytes_(bytes) {}
  bool is_empty() const { return at_ >= bytes_.size(); }
  int below(int n) { return is_empty() ? 0 : static_cast<unsigned char>(bytes_[at_++]) % n; }
  template <class T>
  T value() {
    T value{};
    const size_t n = std::min(sizeof value, bytes_.size() - std::min(at_, bytes_.size()));
    std::memcpy(&value, bytes_.data() + at_, n);
    at_ += n;
    return value;
  }

 private:
  const std::string& bytes_;
  size_t at_ = 0;
};

void write_tables(const std::string& path, const std::string& bytes) {
  CheckpointWriter writer(path);
  Source source(bytes);
  for (const char* name : names) {
    const int kind = source.below(4), n_columns = 1 + source.below(4), n_rows = source.below(10);
    std::vector<double> reals(static_cast<size_t>(n_columns * n_rows));
    for (double& value : reals)
      value = source.value<double>();
    std::vector<std::int64_t> integers(static_cast<size_t>(n_rows));
    for (std::int64_t& value : integers)
      value = source.value<std::int64_t>();
    std::string text = bytes.substr(0, static_cast<size_t>(n_rows));
    if (kind == 0) writer.reals(name, "m/s", reals, n_columns, n_rows);
    if (kind == 1) writer.integers(name, integers, n_rows);
    if (kind == 2) writer.text(name, text);
  }
  writer.publish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const std::string path = scratch_path();
  diptych::tests::take_or_refuse(data, size, [](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    read_all(path);
  });
  if (size > 256) return 0;  // a file, not a choice of tables
  return diptych::tests::take_or_refuse(data, size, [](const std::string& bytes) {
    write_tables(path, bytes);
    read_all(path);
  });
}
