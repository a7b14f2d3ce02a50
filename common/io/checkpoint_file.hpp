#pragma once
/// Checkpoints as HDF5 files: each table of an archive is a data set under its name, with its unit
/// as an attribute; "index" lists them all, "format" is the number of the format. The file is
/// sealed (sealed_file.hpp), and there whole or not at all. h5dump and h5py read it. The seal is
/// against damage, not against malice: HDF5 1.10 crashes on some contents that nobody but an
/// attacker seals, so a checkpoint is to be trusted like the program that wrote it. Test:
/// tests/common/io/checkpoint_file_test.cpp

#include "common/algebra/archive.hpp"
#include "common/io/hdf5_file.hpp"

#include <set>
#include <string>
#include <vector>

namespace diptych::io {

/// Of what is in the file and where. A file of another format is refused.
constexpr std::int64_t checkpoint_format = 4;

class CheckpointWriter : public algebra::Archive {
 public:
  /// Nothing is at the path before publish().
  explicit CheckpointWriter(const std::string& path);

  bool is_loading() const override { return false; }
  void reals(const std::string& name,
             const std::string& unit,
             std::vector<double>& values,
             int n_columns,
             std::int64_t n_rows) override;
  void rows(const std::string& name,
            const std::string& unit,
            int n_columns,
            std::int64_t n_rows,
            const Rows& part) override;
  void integers(const std::string& name,
                std::vector<std::int64_t>& values,
                std::int64_t n_rows) override;
  void text(const std::string& name, std::string& value) override;

  /// Puts the file at its path, on the disk. @throws base::EnvironmentError
  void publish();

 private:
  void begin(const std::string& name);

  std::string path_;
  Hdf5File file_;
  std::set<std::string> groups_;
  std::string index_;  ///< a name a line
};

class CheckpointReader : public algebra::Archive {
 public:
  /// @throws base::InputError where the file is damaged, cut off or of another format, with path
  /// and
  ///         reason; base::EnvironmentError where it cannot be read
  explicit CheckpointReader(const std::string& path);

  bool is_loading() const override { return true; }
  void reals(const std::string& name,
             const std::string& unit,
             std::vector<double>& values,
             int n_columns,
             std::int64_t n_rows) override;
  void rows(const std::string& name,
            const std::string& unit,
            int n_columns,
            std::int64_t n_rows,
            const Rows& part) override;
  void integers(const std::string& name,
                std::vector<std::int64_t>& values,
                std::int64_t n_rows) override;
  void text(const std::string& name, std::string& value) override;

  const std::string& path() const { return path_; }
  /// All has been taken. @throws base::InputError naming what has not: it is of another program
  void finish() const;

 private:
  /// The shape of a table that is there, and from now on is taken.
  std::vector<std::int64_t> shape_of(const std::string& name);
  /// The same of a table of doubles that must have this shape.
  void require_reals(const std::string& name, int n_columns, std::int64_t n_rows);
  [[noreturn]] void refuse(const std::string& what) const;

  std::string path_;
  Hdf5File file_;
  std::set<std::string> left_;  ///< names that have not been taken
};

}  // namespace diptych::io
