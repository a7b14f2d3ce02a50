#pragma once
/// Named tables of numbers that a state is kept in and comes back from. What is kept is listed
/// once, by a function archive(..., Archive&) that goes both ways: what is written is what is read.
/// Where the tables stand is up to who derives from this (common/io/checkpoint_file.hpp). Test:
/// tests/common/io/checkpoint_file_test.cpp

#include "common/algebra/vectors.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych::algebra {

class Archive {
 public:
  /// As many rows as the table has.
  static constexpr std::int64_t any_number = -1;

  /// The rows of any part of a table, from `first` on: puts them into values, [n][n_columns], or
  /// takes them where the archive is loading.
  using Rows = std::function<void(std::int64_t first, std::span<double> values)>;

  virtual ~Archive() = default;
  /// Whether values are taken from it (true) or put into it.
  virtual bool is_loading() const = 0;
  /// A table of doubles, to the last bit.
  /// @param name    "group/name", each once
  /// @param unit    of all values, "-" where there is none
  /// @param values  [n_rows][n_columns], replaced where it is loading
  /// @param n_rows  that there must be; any_number: any
  /// @throws base::InputError where it is loading and has no such table of this shape
  virtual void reals(const std::string& name,
                     const std::string& unit,
                     std::vector<double>& values,
                     int n_columns = 1,
                     std::int64_t n_rows = any_number) = 0;
  /// The same a part after the other, so that nobody holds the whole of it.
  virtual void rows(const std::string& name,
                    const std::string& unit,
                    int n_columns,
                    std::int64_t n_rows,
                    const Rows& part) = 0;
  /// The same of whole numbers, [n_rows].
  virtual void integers(const std::string& name,
                        std::vector<std::int64_t>& values,
                        std::int64_t n_rows = any_number) = 0;
  /// A text, byte by byte.
  virtual void text(const std::string& name, std::string& value) = 0;

  /// Texts without line breaks.
  void texts(const std::string& name, std::vector<std::string>& values) {
    std::string lines;
    for (const std::string& value : values)
      lines += value + "\n";
    text(name, lines);
    values.clear();
    for (size_t begin = 0, end; (end = lines.find('\n', begin)) != lines.npos; begin = end + 1)
      values.push_back(lines.substr(begin, end - begin));
  }
  void real(const std::string& name, const std::string& unit, double& value) {
    std::vector<double> one{value};
    reals(name, unit, one, 1, 1);
    value = one.front();
  }
  /// Of any integral type, bool too.
  template <class Integer>
  void integer(const std::string& name, Integer& value) {
    std::vector<std::int64_t> one{static_cast<std::int64_t>(value)};
    integers(name, one, 1);
    value = static_cast<Integer>(one.front());
  }
  void vector(const std::string& name, const std::string& unit, Vec3& value) {
    std::vector<Vec3> one{value};
    vectors(name, unit, one, 1);
    value = one.front();
  }
  /// [n_rows][3]
  void vectors(const std::string& name,
               const std::string& unit,
               std::vector<Vec3>& values,
               std::int64_t n_rows = any_number) {
    std::vector<double> flat;
    for (const Vec3& v : values)
      flat.insert(flat.end(), v.data(), v.data() + 3);
    reals(name, unit, flat, 3, n_rows);
    values.resize(flat.size() / 3);
    for (size_t k = 0; k < flat.size(); ++k)
      values[k / 3][static_cast<int>(k % 3)] = flat[k];
  }
};

/// use(first, n) of the parts that the rows of a table come in; no table comes in none.
template <class Use>
void for_parts(std::int64_t n_rows, const Use& use) {
  constexpr std::int64_t length = 1 << 15;
  std::int64_t first = 0;
  do {
    use(first, std::min(length, n_rows - first));
    first += length;
  } while (first < n_rows);
}

}  // namespace diptych::algebra
