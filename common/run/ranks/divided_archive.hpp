#pragma once
/// An archive of a body that is divided among ranks, which all call the same of it together. The
/// file is that of rank 0. Tables of nodes come from the ranks that own the nodes, a part at a
/// time, or go to all; all else is the same on all ranks. What goes wrong with the file is thrown
/// on all of them. Test: tests/ranks

#include "common/algebra/archive.hpp"
#include "common/parallel/part.hpp"

namespace diptych::run {

class DividedArchive : public algebra::Archive {
 public:
  /// @param part  of this rank, not the whole
  /// @param file  on other ranks nothing but whether it is loading is asked of it
  DividedArchive(const parallel::Part& part, algebra::Archive& file)
      : part_(part), ranks_(part.ranks()), file_(file) {}
  bool is_loading() const override { return file_.is_loading(); }
  void reals(const std::string& name,
             const std::string& unit,
             std::vector<double>& values,
             int n_columns,
             std::int64_t n_rows) override;
  /// @pre a row for each node
  void rows(const std::string& name,
            const std::string& unit,
            int n_columns,
            std::int64_t n_rows,
            const Rows& part) override;
  void integers(const std::string& name,
                std::vector<std::int64_t>& values,
                std::int64_t n_rows) override;
  void text(const std::string& name, std::string& value) override;

 private:
  template <class Use>
  void use_file(const Use& use);
  template <class Value, class Use>
  void use_file_for(Value& value, const Use& use);
  void say(bool goes_on);
  void require_going_on();
  void collect(std::int64_t first, std::span<double> values, int n_columns, const Rows& put);

  const parallel::Part& part_;
  parallel::Communicator& ranks_;
  algebra::Archive& file_;
};

/// Of other ranks than 0, which have no file.
class NoArchive : public algebra::Archive {
 public:
  explicit NoArchive(bool is_loading) : is_loading_(is_loading) {}
  bool is_loading() const override { return is_loading_; }
  void reals(
      const std::string&, const std::string&, std::vector<double>&, int, std::int64_t) override {}
  void rows(const std::string&, const std::string&, int, std::int64_t, const Rows&) override {}
  void integers(const std::string&, std::vector<std::int64_t>&, std::int64_t) override {}
  void text(const std::string&, std::string&) override {}

 private:
  bool is_loading_;
};

}  // namespace diptych::run
