#include "common/io/hdf5_file.hpp"

#include "common/base/error.hpp"
#include "common/io/hdf5_driver.hpp"
#include "common/io/sealed_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace diptych::io {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));
static_assert(sizeof(hsize_t) == sizeof(unsigned long long));

/// Owns one identifier of HDF5 and the function that closes it.
class Owned {
 public:
  using Close = herr_t (*)(hid_t);
  Owned(hid_t id, Close closer) : id_(id), close_(closer) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool failed() const { return id_ < 0; }
  bool close() { return close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// Walks upwards from where the failure arose; the first entry says what went wrong.
herr_t take_first(unsigned n, const H5E_error2_t* entry, void* reason) {
  if (n == 0 && entry->desc != nullptr) *static_cast<std::string*>(reason) = entry->desc;
  return 0;
}

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "no reason given by HDF5" : reason;
}

void be_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The format is bounded above by HDF5 1.10, so that VTK 9.1 and ParaView 5.11 read it, and below
/// by the earliest: H5Fget_file_image of 1.10.8 clears the mark "open for writing" of the newer
/// superblocks without renewing the checksum over it, and nothing could then open the file.
bool set_format(hid_t access) {
  return H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V110) >= 0;
}

/// Without the time at which an object was made: files with the same content have the same bytes.
bool leave_out_times(hid_t properties) {
  return properties >= 0 && H5Pset_obj_track_times(properties, false) >= 0;
}

/// The same of the group that a file itself is.
hid_t create_file(const std::string& path, hid_t access) {
  const Owned properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  if (!leave_out_times(properties.get())) return -1;
  return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties.get(), access);
}

/// Without a file behind it.
bool set_in_memory(hid_t access) {
  constexpr size_t growth = size_t{1} << 20;
  return access >= 0 && H5Pset_fapl_core(access, growth, false) >= 0;
}

herr_t append_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

hid_t stored_type(hid_t memory_type) {
  if (H5Tequal(memory_type, H5T_NATIVE_DOUBLE) > 0) return H5T_IEEE_F64LE;
  if (H5Tequal(memory_type, H5T_NATIVE_FLOAT) > 0) return H5T_IEEE_F32LE;
  if (H5Tequal(memory_type, H5T_NATIVE_INT64) > 0) return H5T_STD_I64LE;
  return H5T_STD_U8LE;
}

/// Chunks of at most 2^17 rows, each shuffled and then compressed.
bool compress(hid_t properties, hsize_t n_rows) {
  const hsize_t chunk = std::min<hsize_t>(n_rows, hsize_t{1} << 17);
  return H5Pset_chunk(properties, 1, &chunk) >= 0 && H5Pset_shuffle(properties) >= 0 &&
         H5Pset_deflate(properties, 1) >= 0;
}

hid_t type_of(float) {
  return H5T_NATIVE_FLOAT;
}
hid_t type_of(double) {
  return H5T_NATIVE_DOUBLE;
}

std::array<unsigned long long, 2> table_shape(size_t n_values, int n_columns) {
  return {n_values / static_cast<size_t>(n_columns), static_cast<unsigned long long>(n_columns)};
}

}  // namespace

Hdf5File::Hdf5File(std::string path,
                   std::int64_t file,
                   const std::string& what,
                   std::unique_ptr<OnDisk> on_disk)
    : path_(std::move(path)), on_disk_(std::move(on_disk)), file_(file) {
  if (file_ < 0) fail(what);
}

Hdf5File Hdf5File::create(const std::string& path) {
  be_quiet();
  const Owned access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const hid_t file = set_in_memory(access.get()) && set_format(access.get())
                         ? create_file(path, access.get())
                         : -1;
  return {path, file, "cannot create it in memory"};
}

Hdf5File Hdf5File::create_on_disk(const std::string& path) {
  be_quiet();
  auto on_disk = std::make_unique<OnDisk>();
  on_disk->out.emplace(path);
  const Owned access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const hid_t file =
      set_driver(access.get(), *on_disk->out, on_disk->end) && set_format(access.get())
          ? create_file(path, access.get())
          : -1;
  return {path, file, "cannot create it", std::move(on_disk)};
}

Hdf5File Hdf5File::open_for_reading(const std::string& path) {
  be_quiet();
  return {path, H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "cannot open it"};
}

Hdf5File Hdf5File::open_alone(const std::string& path) {
  be_quiet();
  auto on_disk = std::make_unique<OnDisk>();
  on_disk->in.emplace(path);
  const Owned access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const hid_t file = set_driver(access.get(), *on_disk->in)
                         ? H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get())
                         : -1;
  return {path, file, "cannot open it", std::move(on_disk)};
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)),
      on_disk_(std::move(other.on_disk_)),
      file_(std::exchange(other.file_, -1)) {}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::fail(const std::string& what) const {
  if (on_disk_ && on_disk_->out) on_disk_->out->require_written();
  throw base::EnvironmentError(fmt::format("HDF5 file '{}': {}: {}", path_, what, hdf5_reason()));
}

void Hdf5File::create_group(const std::string& name) {
  const Owned properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  if (!leave_out_times(properties.get())) fail("cannot create group '" + name + "'");
  Owned group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
              H5Gclose);
  if (group.failed() || !group.close()) fail("cannot create group '" + name + "'");
}

void Hdf5File::write_attribute(const std::string& group,
                               const std::string& name,
                               const std::string& text) {
  const std::string what = "cannot write attribute '" + name + "'";
  const Owned type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (type.failed() || H5Tset_size(type.get(), std::max<size_t>(text.size(), 1)) < 0 ||
      H5Tset_strpad(type.get(), H5T_STR_NULLPAD) < 0) {
    fail(what);
  }
  const Owned space(H5Screate(H5S_SCALAR), H5Sclose);
  const Owned attribute(H5Acreate_by_name(file_, group.c_str(), name.c_str(), type.get(),
                                          space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  if (attribute.failed() || H5Awrite(attribute.get(), type.get(), text.data()) < 0) fail(what);
}

void Hdf5File::write_attribute(const std::string& group,
                               const std::string& name,
                               std::span<const int> values) {
  const hsize_t n = values.size();
  const Owned space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  const Owned attribute(H5Acreate_by_name(file_, group.c_str(), name.c_str(), H5T_STD_I32LE,
                                          space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  if (attribute.failed() || H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()) < 0) {
    fail("cannot write attribute '" + name + "'");
  }
}

void Hdf5File::write_values(const std::string& name,
                            const void* values,
                            std::int64_t memory_type,
                            std::span<const unsigned long long> shape,
                            bool compressed) {
  const std::string what = "cannot write '" + name + "'";
  const Owned space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                    H5Sclose);
  const Owned properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (space.failed() || !leave_out_times(properties.get())) fail(what);
  if (compressed && shape[0] > 0 && !compress(properties.get(), shape[0])) fail(what);
  Owned set(H5Dcreate2(file_, name.c_str(), stored_type(memory_type), space.get(), H5P_DEFAULT,
                       properties.get(), H5P_DEFAULT),
            H5Dclose);
  if (set.failed() || H5Dwrite(set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0 ||
      !set.close()) {
    fail(what);
  }
}

void Hdf5File::write(const std::string& name, std::span<const double> values, int n_columns) {
  const auto shape = table_shape(values.size(), n_columns);
  write_values(name, values.data(), H5T_NATIVE_DOUBLE,
               std::span(shape).first(n_columns == 1 ? 1 : 2), false);
}

template <class Real>
void Hdf5File::write_rows(const std::string& name,
                          std::span<const Real> values,
                          int n_columns,
                          std::int64_t first,
                          std::int64_t n_rows) {
  const std::string what = "cannot write '" + name + "'";
  const auto columns = static_cast<hsize_t>(n_columns);
  const int n_dimensions = n_columns == 1 ? 1 : 2;
  const hsize_t whole[2] = {static_cast<hsize_t>(n_rows), columns};
  const hsize_t begin[2] = {static_cast<hsize_t>(first), 0};
  const hsize_t part[2] = {values.size() / columns, columns};
  const hid_t type = type_of(Real{});
  const Owned space(H5Screate_simple(n_dimensions, whole, nullptr), H5Sclose);
  const Owned memory(H5Screate_simple(n_dimensions, part, nullptr), H5Sclose);
  const Owned properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (space.failed() || memory.failed() || !leave_out_times(properties.get())) fail(what);
  Owned set(first == 0 ? H5Dcreate2(file_, name.c_str(), stored_type(type), space.get(),
                                    H5P_DEFAULT, properties.get(), H5P_DEFAULT)
                       : H5Dopen2(file_, name.c_str(), H5P_DEFAULT),
            H5Dclose);
  if (set.failed() ||
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin, nullptr, part, nullptr) < 0 ||
      H5Dwrite(set.get(), type, memory.get(), space.get(), H5P_DEFAULT, values.data()) < 0 ||
      !set.close()) {
    fail(what);
  }
}

template void Hdf5File::write_rows(
    const std::string&, std::span<const float>, int, std::int64_t, std::int64_t);
template void Hdf5File::write_rows(
    const std::string&, std::span<const double>, int, std::int64_t, std::int64_t);

void Hdf5File::write(const std::string& name,
                     std::span<const std::int64_t> values,
                     bool compressed) {
  const auto shape = table_shape(values.size(), 1);
  write_values(name, values.data(), H5T_NATIVE_INT64, std::span(shape).first(1), compressed);
}

void Hdf5File::write(const std::string& name,
                     std::span<const std::uint8_t> values,
                     bool compressed) {
  const auto shape = table_shape(values.size(), 1);
  write_values(name, values.data(), H5T_NATIVE_UINT8, std::span(shape).first(1), compressed);
}

void Hdf5File::link(const std::string& name, const std::string& file, const std::string& target) {
  if (H5Lcreate_external(file.c_str(), target.c_str(), file_, name.c_str(), H5P_DEFAULT,
                         H5P_DEFAULT) < 0) {
    fail("cannot link '" + name + "' to '" + file + "'");
  }
}

std::string Hdf5File::take_image() {
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("cannot finish it");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  if (size <= 0) fail("cannot take its size");
  std::string image;
  constexpr size_t seal = 4096;  // and a part in a hundred: it is appended without a copy
  image.reserve(static_cast<size_t>(size) + static_cast<size_t>(size) / 100 + seal);
  image.resize(static_cast<size_t>(size));
  if (H5Fget_file_image(file_, image.data(), image.size()) != size) fail("cannot take its bytes");
  if (H5Fclose(std::exchange(file_, -1)) < 0) fail("cannot close it");
  return image;
}

void Hdf5File::publish() {
  if (!on_disk_) {
    write_sealed_file(path_, take_image());
    return;
  }
  if (H5Fclose(std::exchange(file_, -1)) < 0) fail("cannot close it");
  seal(*on_disk_->out, on_disk_->end);
  on_disk_->out->publish();
}

bool Hdf5File::contains(const std::string& name) const {
  // H5Lexists asks for each step of the path in turn; a missing parent is an error to it.
  for (size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) {
      H5Eclear2(H5E_DEFAULT);
      return false;
    }
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::names(const std::string& group) const {
  std::vector<std::string> result;
  hsize_t index = 0;
  const Owned opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (opened.failed() ||
      H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, &index, append_name, &result) < 0) {
    fail("cannot list group '" + group + "'");
  }
  return result;
}

std::vector<std::int64_t> Hdf5File::shape(const std::string& name) const {
  const Owned set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.failed()) fail("cannot open '" + name + "'");
  const Owned space(H5Dget_space(set.get()), H5Sclose);
  const int rank = space.failed() ? -1 : H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) fail("cannot read the shape of '" + name + "'");
  std::vector<hsize_t> extent(static_cast<size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr) < 0) {
    fail("cannot read the shape of '" + name + "'");
  }
  return {extent.begin(), extent.end()};
}

/// A damaged header may promise any size: contiguous storage that is shorter is refused before
/// memory is asked for.  @return how many values there are
std::uint64_t Hdf5File::require_values(const std::string& name) const {
  const std::string what = "cannot read '" + name + "'";
  std::uint64_t n_values = 1;
  for (const std::int64_t n : shape(name))
    n_values *= static_cast<std::uint64_t>(n);
  const Owned set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Owned properties(set.failed() ? -1 : H5Dget_create_plist(set.get()), H5Pclose);
  const Owned type(set.failed() ? -1 : H5Dget_type(set.get()), H5Tclose);
  if (set.failed() || properties.failed() || type.failed()) fail(what);
  if (H5Pget_layout(properties.get()) == H5D_CONTIGUOUS &&
      H5Dget_storage_size(set.get()) / H5Tget_size(type.get()) < n_values) {
    fail(what + ": the file holds fewer values than it says");
  }
  return n_values;
}

template <class Number>
std::vector<Number> Hdf5File::read_values(const std::string& name, std::int64_t memory_type) const {
  const std::string what = "cannot read '" + name + "'";
  const std::uint64_t n_values = require_values(name);
  const Owned set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.failed()) fail(what);
  std::vector<Number> values(n_values);
  if (H5Dread(set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) fail(what);
  return values;
}

std::vector<double> Hdf5File::read_doubles(const std::string& name) const {
  return read_values<double>(name, H5T_NATIVE_DOUBLE);
}

void Hdf5File::read_rows(const std::string& name,
                         std::span<double> values,
                         int n_columns,
                         std::int64_t first) const {
  const std::string what = "cannot read '" + name + "'";
  const auto columns = static_cast<hsize_t>(n_columns);
  const hsize_t begin[2] = {static_cast<hsize_t>(first), 0};
  const hsize_t part[2] = {values.size() / columns, columns};
  const Owned set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Owned space(set.failed() ? -1 : H5Dget_space(set.get()), H5Sclose);
  const Owned memory(H5Screate_simple(n_columns == 1 ? 1 : 2, part, nullptr), H5Sclose);
  if (set.failed() || space.failed() || memory.failed() ||
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin, nullptr, part, nullptr) < 0 ||
      H5Dread(set.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()) <
          0) {
    fail(what);
  }
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& name) const {
  return read_values<std::int64_t>(name, H5T_NATIVE_INT64);
}

}  // namespace diptych::io
