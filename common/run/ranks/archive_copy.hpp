#pragma once
/// What rank 0 loads, for other ranks: a copy in memory of all that is taken from an archive, in
/// the order in which it is taken. Test: tests/common/run/archive_copy_test.cpp

#include "common/algebra/archive.hpp"

#include <cstddef>

namespace diptych::run {

/// Passes on what it is asked for, and keeps a copy of what comes.
class CopyingArchive : public algebra::Archive {
 public:
  /// @pre from.is_loading()
  explicit CopyingArchive(algebra::Archive& from) : from_(from) {}
  bool is_loading() const override { return true; }
  void reals(const std::string& name,
             const std::string& unit,
             std::vector<double>& values,
             int n_columns,
             std::int64_t n_rows) override;
  void integers(const std::string& name,
                std::vector<std::int64_t>& values,
                std::int64_t n_rows) override;
  void text(const std::string& name, std::string& value) override;

  std::vector<std::byte>& copy() { return copy_; }

 private:
  void keep(const void* bytes, size_t n);
  algebra::Archive& from_;
  std::vector<std::byte> copy_;
};

/// Gives what was kept to who asks for the same things in the same order.
class ArchiveCopy : public algebra::Archive {
 public:
  explicit ArchiveCopy(std::vector<std::byte> copy) : copy_(std::move(copy)) {}
  bool is_loading() const override { return true; }
  void reals(const std::string& name,
             const std::string& unit,
             std::vector<double>& values,
             int n_columns,
             std::int64_t n_rows) override;
  void integers(const std::string& name,
                std::vector<std::int64_t>& values,
                std::int64_t n_rows) override;
  void text(const std::string& name, std::string& value) override;

 private:
  template <class Values>
  void take(Values& values);
  std::vector<std::byte> copy_;
  size_t at_ = 0;
};

}  // namespace diptych::run
