#include "meshes/msh/source.hpp"

#include "common/base/error.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace diptych::meshes::msh {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// std::from_chars knows no leading plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

std::string shown(std::string_view word, size_t most) {
  std::string text(word.substr(0, most));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return word.size() > most ? text + "..." : text;
}

void Source::fail_at(std::int64_t place, const std::string& message) const {
  const std::string where =
      is_binary_ ? fmt::format("{}: byte {}", name_, place) : fmt::format("{}:{}", name_, place);
  throw base::InputError(section_.empty() ? fmt::format("{}: {}", where, message)
                                          : fmt::format("{}: {}: {}", where, section_, message));
}

void Source::fail_without_place(const std::string& message) const {
  throw base::InputError(fmt::format("{}: {}", name_, message));
}

void Source::fail_at_end(const char* what) const {
  const std::int64_t place = is_binary_ ? static_cast<std::int64_t>(bytes_.size()) : line_;
  fail_at(place, fmt::format("the file ends where {} should stand (truncated?)", what));
}

void Source::skip_space() {
  while (at_ < bytes_.size() && is_space(bytes_[at_])) {
    if (bytes_[at_] == '\n') ++line_;
    ++at_;
  }
  place_ = is_binary_ ? static_cast<std::int64_t>(at_) : line_;
}

bool Source::at_end() {
  skip_space();
  return at_ == bytes_.size();
}

std::string_view Source::word(const char* what) {
  skip_space();
  if (at_ == bytes_.size()) fail_at_end(what);
  const size_t start = at_;
  while (at_ < bytes_.size() && !is_space(bytes_[at_]))
    ++at_;
  return std::string_view(bytes_).substr(start, at_ - start);
}

std::string_view Source::rest_of_line() {
  const size_t start = at_;
  while (at_ < bytes_.size() && bytes_[at_] != '\n')
    ++at_;
  size_t end = at_;
  if (end > start && bytes_[end - 1] == '\r') --end;
  return std::string_view(bytes_).substr(start, end - start);
}

std::int64_t Source::text_integer(const char* what) {
  const std::string_view text = word(what);
  const std::string_view digits = without_plus(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    fail(fmt::format("{} = {} is beyond 64-bit integers", what, shown(text)));
  }
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    fail(fmt::format("{}: a whole number is needed, not '{}'", what, shown(text)));
  }
  return value;
}

double Source::text_real(const char* what) {
  const std::string_view text = word(what);
  const std::string_view digits = without_plus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    fail(fmt::format("{} = {} is beyond double precision", what, shown(text)));
  }
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    fail(fmt::format("{}: a number is needed, not '{}'", what, shown(text)));
  }
  return value;
}

void Source::expect(const std::string& expected) {
  const std::string_view text = word(expected.c_str());
  if (text == expected) return;
  fail(fmt::format("{} is needed, not '{}' (do the counts fit the lists?)", expected, shown(text)));
}

void Source::skip_behind(const std::string& mark) {
  const size_t found = bytes_.find("\n" + mark, at_);
  if (found == std::string::npos) fail(fmt::format("no {} follows (truncated?)", mark));
  for (; at_ < found; ++at_) {
    if (bytes_[at_] == '\n') ++line_;
  }
  expect(mark);
}

void Source::end_of_line_before_block() {
  if (at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
  if (at_ >= bytes_.size()) fail_at_end("a binary block");
  if (bytes_[at_] != '\n') {
    place_ = static_cast<std::int64_t>(at_);
    fail("a line end is needed before the binary block");
  }
  ++at_;
  ++line_;
}

template <class T>
T Source::raw(const char* what) {
  place_ = static_cast<std::int64_t>(at_);
  if (n_left() < static_cast<std::int64_t>(sizeof(T))) fail_at_end(what);
  T value;
  std::memcpy(&value, bytes_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  return value;
}

std::int32_t Source::raw_integer(const char* what) {
  return raw<std::int32_t>(what);
}

std::int32_t Source::integer(const char* what) {
  if (is_binary_) return raw<std::int32_t>(what);
  const std::int64_t value = text_integer(what);
  if (value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::int32_t>::max()) {
    fail(fmt::format("{} = {} is beyond 32-bit integers", what, value));
  }
  return static_cast<std::int32_t>(value);
}

std::int64_t Source::size(const char* what) {
  std::int64_t value = 0;
  if (is_binary_) {
    const auto bits = raw<std::uint64_t>(what);
    if (bits > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      fail(fmt::format("{} = {} is beyond 64-bit integers", what, bits));
    }
    value = static_cast<std::int64_t>(bits);
  } else {
    value = text_integer(what);
  }
  if (value < 0) fail(fmt::format("{} = {} must not be negative", what, value));
  return value;
}

double Source::real(const char* what) {
  return is_binary_ ? raw<double>(what) : text_real(what);
}

double Source::finite_real(const char* what) {
  const double value = real(what);
  if (!std::isfinite(value)) fail(fmt::format("{} = {} is not finite", what, value));
  return value;
}

void Source::check_count(std::int64_t count,
                         std::int64_t n_numbers,
                         std::int64_t n_bytes,
                         const char* what) const {
  const std::int64_t least = is_binary_ ? n_bytes : 2 * n_numbers;
  if (count < 0) fail(fmt::format("{} = {} must not be negative", what, count));
  if (count > n_left() / least) {
    fail(fmt::format("{} = {} is more than the rest of the file ({} bytes) can hold", what, count,
                     n_left()));
  }
}

}  // namespace diptych::meshes::msh
