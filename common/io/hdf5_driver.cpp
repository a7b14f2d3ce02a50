#include "common/io/hdf5_driver.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

namespace diptych::io {

namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// Of a property list.
struct Info {
  UnfinishedFile* out = nullptr;
  std::int64_t* end = nullptr;
  const ReadableFile* in = nullptr;
};

struct DriverFile {
  H5FD_t of_hdf5{};  ///< first: HDF5 knows it by its address
  Info info;
  haddr_t allocated = 0;  ///< bytes that HDF5 has a use for
  haddr_t written = 0;    ///< bytes that are there
};

DriverFile& of(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& of(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* info = static_cast<const Info*>(H5Pget_driver_info(access));
  auto* file = info != nullptr ? new (std::nothrow) DriverFile : nullptr;
  if (file == nullptr) return nullptr;
  file->info = *info;
  if (info->in != nullptr) file->written = static_cast<haddr_t>(info->in->size());
  return &file->of_hdf5;
}

herr_t close_file(H5FD_t* file) {
  if (of(file).info.end != nullptr)
    *of(file).info.end = static_cast<std::int64_t>(of(file).allocated);
  delete &of(file);
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) {
  return of(file).allocated;
}

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).allocated = end;
  return 0;
}

haddr_t written(const H5FD_t* file, H5FD_mem_t) {
  return of(file).written;
}

/// What is not there reads as zeros.
herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t begin, size_t n, void* to) {
  const DriverFile& from = of(file);
  const std::span<char> bytes(static_cast<char*>(to), n);
  const size_t n_there =
      begin < from.written ? static_cast<size_t>(std::min<haddr_t>(n, from.written - begin)) : 0;
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(n_there), bytes.end(), '\0');
  const std::span<char> there = bytes.first(n_there);
  const auto place = static_cast<std::int64_t>(begin);
  const bool is_read =
      from.info.in != nullptr ? from.info.in->get(place, there) : from.info.out->get(place, there);
  return is_read ? 0 : -1;
}

/// Never fails: see above.
herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t begin, size_t n, const void* from) {
  DriverFile& to = of(file);
  if (to.info.out == nullptr) return -1;
  to.info.out->put(static_cast<std::int64_t>(begin), {static_cast<const char*>(from), n});
  to.written = std::max(to.written, begin + n);
  return 0;
}

hid_t driver() {
  static const hid_t id = [] {
    static H5FD_class_t of_files{};
    of_files.name = "diptych";
    of_files.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
    of_files.fc_degree = H5F_CLOSE_WEAK;
    of_files.fapl_size = sizeof(Info);
    of_files.open = open_file;
    of_files.close = close_file;
    of_files.get_eoa = allocated;
    of_files.set_eoa = allocate;
    of_files.get_eof = written;
    of_files.read = read;
    of_files.write = write;
    const H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(kinds), std::end(kinds), of_files.fl_map);
    return H5FDregister(&of_files);
  }();
  return id;
}

bool set(hid_t access, const Info& info) {
  return driver() >= 0 && H5Pset_driver(access, driver(), &info) >= 0;
}

}  // namespace

bool set_driver(std::int64_t access, UnfinishedFile& file, std::int64_t& end) {
  return set(access, {&file, &end, nullptr});
}

bool set_driver(std::int64_t access, const ReadableFile& file) {
  return set(access, {nullptr, nullptr, &file});
}

}  // namespace diptych::io
