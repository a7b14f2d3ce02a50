#pragma once
/// The state that rank 0 has, for all ranks: what rank 0 keeps in it is what the others load, part
/// by part of each table, so that no rank holds a copy of the whole. Test: tests/ranks

#include "common/algebra/archive.hpp"
#include "common/parallel/sharing.hpp"

namespace diptych::run {

class SharingArchive : public algebra::Archive {
 public:
  explicit SharingArchive(parallel::Communicator& ranks) : ranks_(ranks) {}
  bool is_loading() const override { return ranks_.rank() != 0; }
  void reals(const std::string&,
             const std::string&,
             std::vector<double>& values,
             int,
             std::int64_t) override {
    parallel::share(ranks_, values);
  }
  void rows(const std::string&,
            const std::string&,
            int n_columns,
            std::int64_t n_rows,
            const Rows& part) override {
    std::vector<double> values;
    algebra::for_parts(n_rows, [&](std::int64_t first, std::int64_t n) {
      values.resize(static_cast<size_t>(n * n_columns));
      if (!is_loading()) part(first, values);
      ranks_.broadcast(parallel::bytes_of(values.data()),
                       std::ssize(values) * static_cast<std::int64_t>(sizeof(double)));
      if (is_loading()) part(first, values);
    });
  }
  void integers(const std::string&, std::vector<std::int64_t>& values, std::int64_t) override {
    parallel::share(ranks_, values);
  }
  void text(const std::string&, std::string& value) override { parallel::share(ranks_, value); }

 private:
  parallel::Communicator& ranks_;
};

}  // namespace diptych::run
