#pragma once
/// HDF5 files through the C API (1.10, serial), reduced to what Diptych writes and reads: groups,
/// one- and two-dimensional data sets of a few number types, attributes, external links. Every
/// return value is checked; a failure is a base::EnvironmentError with the path, what was wanted
/// and HDF5's own reason. HDF5's printing to stderr is switched off in each thread that opens a
/// file here. HDF5 itself is included in hdf5_file.cpp and in no header.
///
/// Small files are made in memory and written by write_sealed_file, at the price of twice their
/// size; large ones on the disk (hdf5_driver.hpp), a part of a data set at a time. Either way what
/// fails has an errno, and what was begun is removed. Test: tests/common/io/field_writer_test.cpp

#include "common/io/atomic_file.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych::io {

class Hdf5File {
 public:
  /// Starts a file in memory; nothing is at `path` before publish().
  static Hdf5File create(const std::string& path);
  /// The same on the disk, under another name. @throws base::EnvironmentError
  static Hdf5File create_on_disk(const std::string& path);
  static Hdf5File open_for_reading(const std::string& path);
  /// The same without locks on the file, and without links to others.
  static Hdf5File open_alone(const std::string& path);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  Hdf5File& operator=(Hdf5File&&) = delete;
  ~Hdf5File();

  void create_group(const std::string& name);
  void write_attribute(const std::string& group, const std::string& name, const std::string& text);
  void write_attribute(const std::string& group,
                       const std::string& name,
                       std::span<const int> values);

  /// A data set of shape [values.size() / n_columns][n_columns], or of one dimension for
  /// n_columns = 1. compressed: gzip 1 after shuffle, worth it for integers.
  void write(const std::string& name, std::span<const double> values, int n_columns = 1);
  /// Rows [first, first + values.size() / n_columns) of a data set of n_rows, which is made with
  /// the first of them.
  /// @param values  of float or double
  template <class Real>
  void write_rows(const std::string& name,
                  std::span<const Real> values,
                  int n_columns,
                  std::int64_t first,
                  std::int64_t n_rows);
  void write(const std::string& name,
             std::span<const std::int64_t> values,
             bool compressed = false);
  void write(const std::string& name,
             std::span<const std::uint8_t> values,
             bool compressed = false);

  /// `name` here stands for `target` of `file`, a path relative to this file's folder.
  void link(const std::string& name, const std::string& file, const std::string& target);

  /// Closes it and writes it to the path given to create(), whole or not at all.
  void publish();
  /// Closes it. @return its bytes
  std::string take_image();

  bool contains(const std::string& name) const;
  std::vector<std::string> names(const std::string& group) const;  ///< sorted
  std::vector<std::int64_t> shape(const std::string& name) const;
  std::vector<double> read_doubles(const std::string& name) const;  ///< row by row
  /// Rows of a data set from `first` on, as many as there is room for.
  void read_rows(const std::string& name,
                 std::span<double> values,
                 int n_columns,
                 std::int64_t first) const;
  std::vector<std::int64_t> read_integers(const std::string& name) const;

 private:
  /// What HDF5 writes to, or reads, where that is a file of ours.
  struct OnDisk {
    std::optional<UnfinishedFile> out;
    std::optional<ReadableFile> in;
    std::int64_t end = 0;
  };

  Hdf5File(std::string path,
           std::int64_t file,
           const std::string& what,
           std::unique_ptr<OnDisk> on_disk = nullptr);
  void write_values(const std::string& name,
                    const void* values,
                    std::int64_t memory_type,
                    std::span<const unsigned long long> shape,
                    bool compressed);
  std::uint64_t require_values(const std::string& name) const;
  template <class Number>
  std::vector<Number> read_values(const std::string& name, std::int64_t memory_type) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;  ///< where the file is or will be
  std::unique_ptr<OnDisk> on_disk_;
  std::int64_t file_;  ///< hid_t; negative once closed
};

}  // namespace diptych::io
