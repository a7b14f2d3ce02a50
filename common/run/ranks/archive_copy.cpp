#include "common/run/ranks/archive_copy.hpp"

#include <cstring>
#include <stdexcept>

namespace diptych::run {

void CopyingArchive::keep(const void* bytes, size_t n) {
  const auto* size = reinterpret_cast<const std::byte*>(&n);
  const auto* first = static_cast<const std::byte*>(bytes);
  copy_.insert(copy_.end(), size, size + sizeof n);
  copy_.insert(copy_.end(), first, first + n);
}

void CopyingArchive::reals(const std::string& name,
                           const std::string& unit,
                           std::vector<double>& values,
                           int n_columns,
                           std::int64_t n_rows) {
  from_.reals(name, unit, values, n_columns, n_rows);
  keep(values.data(), values.size() * sizeof(double));
}

void CopyingArchive::integers(const std::string& name,
                              std::vector<std::int64_t>& values,
                              std::int64_t n_rows) {
  from_.integers(name, values, n_rows);
  keep(values.data(), values.size() * sizeof(std::int64_t));
}

void CopyingArchive::text(const std::string& name, std::string& value) {
  from_.text(name, value);
  keep(value.data(), value.size());
}

template <class Values>
void ArchiveCopy::take(Values& values) {
  using Value = typename Values::value_type;
  size_t n = 0;
  if (at_ + sizeof n > copy_.size()) throw std::logic_error("more is asked for than was kept");
  std::memcpy(&n, copy_.data() + at_, sizeof n);
  at_ += sizeof n;
  values.resize(n / sizeof(Value));
  if (n > 0) std::memcpy(values.data(), copy_.data() + at_, n);
  at_ += n;
}

void ArchiveCopy::reals(
    const std::string&, const std::string&, std::vector<double>& values, int, std::int64_t) {
  take(values);
}

void ArchiveCopy::integers(const std::string&, std::vector<std::int64_t>& values, std::int64_t) {
  take(values);
}

void ArchiveCopy::text(const std::string&, std::string& value) {
  take(value);
}

}  // namespace diptych::run
