#pragma once
/// The bytes of a .msh file, read number by number in ASCII or binary, with the place of each item
/// for messages: the line in ASCII files, the byte offset in binary ones. Nothing is read past the
/// end, and no count is believed that the rest of the file could not hold.

#include <cstdint>
#include <string>
#include <string_view>

namespace diptych::meshes::msh {

class Source {
 public:
  /// @param bytes  the whole file
  /// @param name   its path, for messages
  Source(std::string bytes, std::string name) : bytes_(std::move(bytes)), name_(std::move(name)) {}

  // ---- mode and place
  void set_binary() { is_binary_ = true; }
  bool is_binary() const { return is_binary_; }
  /// The section named in messages, "$Nodes".
  void enter(std::string section) { section_ = std::move(section); }
  /// Of the item last read: line or byte offset.
  std::int64_t place() const { return place_; }
  [[noreturn]] void fail(const std::string& message) const { fail_at(place_, message); }
  [[noreturn]] void fail_at(std::int64_t place, const std::string& message) const;
  /// For messages about the mesh as a whole.
  [[noreturn]] void fail_without_place(const std::string& message) const;

  // ---- text
  /// True where only white space is left.
  bool at_end();
  /// Next word, separated by white space.
  std::string_view word(const char* what);
  /// The rest of this line, without the line end.
  std::string_view rest_of_line();
  std::int64_t text_integer(const char* what);
  double text_real(const char* what);
  /// Refuses anything but `expected` as the next word.
  void expect(const std::string& expected);
  /// Skips to behind the line `mark`, searched as bytes.
  void skip_behind(const std::string& mark);
  /// Passes the line end between text and the binary block that follows it.
  void end_of_line_before_block();

  // ---- numbers of either mode
  std::int32_t integer(const char* what);
  std::int64_t size(const char* what);
  double real(const char* what);
  /// A coordinate: refuses NaN and infinity.
  double finite_real(const char* what);
  /// A binary 32-bit integer, without regard to mode.
  std::int32_t raw_integer(const char* what);

  /// Refuses a count whose items cannot fit into the rest of the file.
  /// @param n_numbers     numbers per item, each at least two bytes of text
  /// @param n_bytes       of one item in binary
  void check_count(std::int64_t count,
                   std::int64_t n_numbers,
                   std::int64_t n_bytes,
                   const char* what) const;

 private:
  void skip_space();
  template <class T>
  T raw(const char* what);
  std::int64_t n_left() const { return static_cast<std::int64_t>(bytes_.size() - at_); }
  [[noreturn]] void fail_at_end(const char* what) const;

  std::string bytes_;
  std::string name_;
  std::string section_;
  size_t at_ = 0;
  std::int64_t line_ = 1;
  std::int64_t place_ = 1;
  bool is_binary_ = false;
};

/// The bytes of a regular file.
/// @throws base::InputError where there is none, base::EnvironmentError where it cannot be read
std::string file_bytes(const std::string& path);

/// A word of the file for messages: at most `most` characters, control characters shown as '?'.
std::string shown(std::string_view word, size_t most = 40);

}  // namespace diptych::meshes::msh
