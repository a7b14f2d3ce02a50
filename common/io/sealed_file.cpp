#include "common/io/sealed_file.hpp"

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <xxhash.h>

namespace diptych::io {

namespace {

/// "diptych seal 1 SIZE HASH\n": size of the content in bytes, hash of all that stands before.
constexpr std::string_view mark = "diptych seal 1 ";
constexpr size_t size_digits = 20, hash_digits = 32;
constexpr size_t last_line = mark.size() + size_digits + 1 + hash_digits + 1;
constexpr size_t piece_line = 16 + 1;

size_t n_pieces_of(size_t size) {
  return (size + sealed_piece - 1) / sealed_piece;
}

std::string piece_hash(std::string_view piece) {
  return fmt::format("{:016x}\n", XXH3_64bits(piece.data(), piece.size()));
}

/// Of the list of hashes, which are of the content.
std::string hash_of(std::string_view list) {
  const XXH128_hash_t hash = XXH3_128bits(list.data(), list.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string last_line_of(size_t size, std::string_view list) {
  return fmt::format("{}{:020} {}\n", mark, size, hash_of(list));
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw base::InputError(fmt::format("{}: {}", path, what));
}

/// Bytes of content that the last line promises. @pre it is one
size_t promised_size(std::string_view line) {
  const std::string_view digits = line.substr(mark.size(), size_digits);
  size_t size = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), size);
  return read.ec == std::errc() && read.ptr == digits.data() + digits.size() ? size : 0;
}

/// What stands behind the content.
struct Seal {
  std::string list;
  void add(std::string_view piece) { list += piece_hash(piece); }
  std::string of(size_t size) const { return list + last_line_of(size, list); }
};

/// Checks what take(begin, n) gives of a file of this size.  @return size of the content
template <class Take>
size_t checked(const std::string& path, size_t all, const Take& take) {
  const size_t n_end = std::min(all, last_line);
  const std::string end(take(all - n_end, n_end));
  if (n_end < last_line || !end.starts_with(mark)) {
    refuse(path,
           fmt::format("is cut off, or damaged at its end, or no sealed file: its {} bytes do "
                       "not end with a seal",
                       all));
  }
  const size_t size = promised_size(end);
  if (size > all || size + n_pieces_of(size) * piece_line + last_line != all) {
    refuse(path, fmt::format("is damaged: its {} bytes are not those of a content of {} bytes with "
                             "its seal",
                             all, size));
  }
  const std::string list(take(size, n_pieces_of(size) * piece_line));
  if (last_line_of(size, list) != end)
    refuse(path, fmt::format("is damaged in its seal, from byte {} on", size));
  for (size_t k = 0; k < n_pieces_of(size); ++k) {
    const size_t begin = k * sealed_piece, n = std::min(sealed_piece, size - begin);
    if (piece_hash(take(begin, n)) == std::string_view(list).substr(k * piece_line, piece_line))
      continue;
    refuse(path, fmt::format("is damaged between byte {} and byte {}", begin, begin + n - 1));
  }
  return size;
}

}  // namespace

std::string sealed(std::string content) {
  const size_t size = content.size();
  Seal marks;
  for (size_t k = 0; k < n_pieces_of(size); ++k)
    marks.add(std::string_view(content).substr(k * sealed_piece, sealed_piece));
  content += marks.of(size);
  return content;
}

void write_sealed_file(const std::string& path, std::string content) {
  write_file_atomically(path, sealed(std::move(content)));
}

void seal(UnfinishedFile& file, std::int64_t size) {
  file.cut(size);
  const auto n = static_cast<size_t>(size);
  Seal marks;
  std::string piece;
  for (size_t begin = 0; begin < n; begin += sealed_piece) {
    piece.resize(std::min(sealed_piece, n - begin));
    file.take(static_cast<std::int64_t>(begin), piece);
    marks.add(piece);
  }
  file.append(marks.of(n));
}

std::string read_sealed_file(const std::string& path) {
  std::string text = read_file(path);
  text.resize(checked(path, text.size(), [&text](size_t begin, size_t n) {
    return std::string_view(text).substr(begin, n);
  }));
  return text;
}

void check_sealed_file(const std::string& path) {
  const ReadableFile file(path);
  std::string piece;
  checked(path, static_cast<size_t>(file.size()), [&](size_t begin, size_t n) {
    piece.resize(n);
    file.take(static_cast<std::int64_t>(begin), piece);
    return std::string_view(piece);
  });
}

}  // namespace diptych::io
