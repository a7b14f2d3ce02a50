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

}  // namespace

std::string sealed(std::string content) {
  const size_t size = content.size();
  std::string list;
  for (size_t k = 0; k < n_pieces_of(size); ++k)
    list += piece_hash(std::string_view(content).substr(k * sealed_piece, sealed_piece));
  content += list;
  content += last_line_of(size, list);
  return content;
}

void write_sealed_file(const std::string& path, std::string content) {
  write_file_atomically(path, sealed(std::move(content)));
}

std::string read_sealed_file(const std::string& path) {
  std::string text = read_file(path);
  const std::string_view all = text;
  const std::string_view end = all.substr(all.size() - std::min(all.size(), last_line));
  if (end.size() < last_line || !end.starts_with(mark)) {
    refuse(path,
           fmt::format("is cut off, or damaged at its end, or no sealed file: its {} bytes do "
                       "not end with a seal",
                       all.size()));
  }
  const size_t size = promised_size(end);
  if (size > all.size() || size + n_pieces_of(size) * piece_line + last_line != all.size()) {
    refuse(path, fmt::format("is damaged: its {} bytes are not those of a content of {} bytes with "
                             "its seal",
                             all.size(), size));
  }
  const std::string_view list = all.substr(size, n_pieces_of(size) * piece_line);
  if (last_line_of(size, list) != end)
    refuse(path, fmt::format("is damaged in its seal, from byte {} on", size));
  for (size_t k = 0; k < n_pieces_of(size); ++k) {
    const size_t begin = k * sealed_piece;
    const std::string_view piece = all.substr(begin, std::min(sealed_piece, size - begin));
    if (piece_hash(piece) == list.substr(k * piece_line, piece_line)) continue;
    refuse(path,
           fmt::format("is damaged between byte {} and byte {}", begin, begin + piece.size() - 1));
  }
  text.resize(size);
  return text;
}

}  // namespace diptych::io
