#include "common/io/checkpoint_file.hpp"

#include "common/base/error.hpp"
#include "common/io/sealed_file.hpp"

#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace diptych::io {

namespace {

constexpr const char* format_name = "format";
constexpr const char* index_name = "index";
constexpr const char* unit_name = "unit";

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string text_in(const Hdf5File& file, const std::string& name) {
  std::string text;
  for (const std::int64_t byte : file.read_integers(name))
    text += static_cast<char>(static_cast<unsigned char>(byte));
  return text;
}

}  // namespace

CheckpointWriter::CheckpointWriter(const std::string& path)
    : path_(path), file_(Hdf5File::create_on_disk(path)) {
  file_.write(format_name, std::span(&checkpoint_format, 1));
}

/// Makes the groups of a name and adds it to the index.
void CheckpointWriter::begin(const std::string& name) {
  for (size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
    if (groups_.insert(name.substr(0, end)).second) file_.create_group(name.substr(0, end));
  }
  index_ += name + "\n";
}

void CheckpointWriter::reals(const std::string& name,
                             const std::string& unit,
                             std::vector<double>& values,
                             int n_columns,
                             std::int64_t n_rows) {
  const auto n = static_cast<std::int64_t>(values.size());
  if (n % n_columns != 0 || (n_rows != any_number && n != n_rows * n_columns))
    throw std::logic_error(fmt::format("{}: {} values in {} columns", name, n, n_columns));
  begin(name);
  file_.write(name, std::span<const double>(values), n_columns);
  file_.write_attribute(name, unit_name, unit);
}

void CheckpointWriter::rows(const std::string& name,
                            const std::string& unit,
                            int n_columns,
                            std::int64_t n_rows,
                            const Rows& part) {
  begin(name);
  std::vector<double> values;
  algebra::for_parts(n_rows, [&](std::int64_t first, std::int64_t n) {
    values.resize(static_cast<size_t>(n * n_columns));
    part(first, values);
    file_.write_rows<double>(name, values, n_columns, first, n_rows);
  });
  file_.write_attribute(name, unit_name, unit);
}

void CheckpointWriter::integers(const std::string& name,
                                std::vector<std::int64_t>& values,
                                std::int64_t) {
  begin(name);
  file_.write(name, std::span<const std::int64_t>(values));
}

void CheckpointWriter::text(const std::string& name, std::string& value) {
  begin(name);
  file_.write(name, bytes_of(value));
}

void CheckpointWriter::publish() {
  file_.write(index_name, bytes_of(index_));
  file_.publish();
}

CheckpointReader::CheckpointReader(const std::string& path)
    : path_(path), file_((check_sealed_file(path), Hdf5File::open_alone(path))) {
  if (!file_.contains(format_name) || !file_.contains(index_name)) refuse("is no checkpoint");
  const std::vector<std::int64_t> format = file_.read_integers(format_name);
  if (format.size() != 1 || format.front() != checkpoint_format) {
    refuse(
        fmt::format("has the format {} of checkpoints, this program reads {}; go on with the "
                    "program that wrote it",
                    format.empty() ? 0 : format.front(), checkpoint_format));
  }
  std::istringstream index(text_in(file_, index_name));
  for (std::string name; std::getline(index, name);)
    left_.insert(name);
}

void CheckpointReader::refuse(const std::string& what) const {
  throw base::InputError(fmt::format("{}: {}", path_, what));
}

std::vector<std::int64_t> CheckpointReader::shape_of(const std::string& name) {
  if (left_.erase(name) == 0 || !file_.contains(name))
    refuse(fmt::format("has no '{}', which this run needs", name));
  return file_.shape(name);
}

void CheckpointReader::require_reals(const std::string& name, int n_columns, std::int64_t n_rows) {
  const std::vector<std::int64_t> shape = shape_of(name);
  const bool fits = n_columns == 1 ? shape.size() == 1 : shape.size() == 2 && shape[1] == n_columns;
  if (!fits || (n_rows != any_number && shape[0] != n_rows)) {
    refuse(fmt::format("has '{}' as {}, this run needs {} of {}", name, fmt::join(shape, " x "),
                       n_rows == any_number ? "rows" : fmt::format("{} rows", n_rows), n_columns));
  }
}

void CheckpointReader::reals(const std::string& name,
                             const std::string&,
                             std::vector<double>& values,
                             int n_columns,
                             std::int64_t n_rows) {
  require_reals(name, n_columns, n_rows);
  values = file_.read_doubles(name);
}

void CheckpointReader::rows(const std::string& name,
                            const std::string&,
                            int n_columns,
                            std::int64_t n_rows,
                            const Rows& part) {
  require_reals(name, n_columns, n_rows);
  std::vector<double> values;
  algebra::for_parts(n_rows, [&](std::int64_t first, std::int64_t n) {
    values.resize(static_cast<size_t>(n * n_columns));
    file_.read_rows(name, values, n_columns, first);
    part(first, values);
  });
}

void CheckpointReader::integers(const std::string& name,
                                std::vector<std::int64_t>& values,
                                std::int64_t n_rows) {
  const std::vector<std::int64_t> shape = shape_of(name);
  if (shape.size() != 1 || (n_rows != any_number && shape[0] != n_rows)) {
    refuse(fmt::format("has '{}' as {}, this run needs {}", name, fmt::join(shape, " x "),
                       n_rows == any_number ? "one row" : fmt::format("{}", n_rows)));
  }
  values = file_.read_integers(name);
}

void CheckpointReader::text(const std::string& name, std::string& value) {
  shape_of(name);
  value = text_in(file_, name);
}

void CheckpointReader::finish() const {
  if (left_.empty()) return;
  refuse(fmt::format("holds '{}', which this run does not have", *left_.begin()));
}

}  // namespace diptych::io
