#include "meshes/geo/geo_scan.hpp"

#include "common/base/error.hpp"
#include "meshes/msh/source.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <vector>

namespace diptych::meshes {

namespace {

namespace fs = std::filesystem;

constexpr size_t most_files = 200;     // of Include and Merge together
constexpr size_t longest_name = 1000;  // Gmsh cuts strings at 1023 characters and reads on behind

enum class Rule {
  never,     ///< a word that nothing harmless needs
  command,   ///< a command where a string follows: Save "x"; but not Save = 1;
  call,      ///< where '(' follows
  redirect,  ///< where > stands behind its parentheses
  read,      ///< a command whose string names a file
  list,      ///< a function whose first argument names a file
  option     ///< an option whose value names a file
};

struct Word {
  std::string_view text;
  Rule rule;
  std::string_view does;
};

constexpr std::string_view runs = "starts another program", writes = "writes files",
                           hides = "makes names out of strings", reads = "reads a file";

constexpr std::array words{
    Word{"SystemCall", Rule::never, runs},
    Word{"System", Rule::command, runs},
    Word{"OnelabRun", Rule::never, runs},
    Word{"ExternalProcess", Rule::never, runs},
    Word{"CommandLine", Rule::never, runs},
    Word{"Plugin", Rule::call, "runs a plugin, which may write files"},
    Word{"CreateDir", Rule::never, writes},
    Word{"PartitionTopologyFile", Rule::never, writes},
    Word{"Print", Rule::command, writes},
    Word{"Save", Rule::command, writes},
    Word{"Printf", Rule::redirect, writes},
    Word{"Error", Rule::redirect, writes},
    Word{"Warning", Rule::redirect, writes},
    Word{"Sleep", Rule::command, "waits"},
    Word{"StringToName", Rule::never, hides},
    Word{"S2N", Rule::never, hides},
    Word{"Include", Rule::read, reads},
    Word{"Merge", Rule::read, reads},
    Word{"MergeWithBoundingBox", Rule::read, reads},
    Word{"Open", Rule::read, reads},
    Word{"ListFromFile", Rule::list, reads},
    Word{"ShapeFromFile", Rule::list, reads},
    Word{"FileName", Rule::option, reads},
};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word_part(char c) {
  return is_letter(c) || (c >= '0' && c <= '9');
}

struct Token {
  enum class Kind { end, string, word, number, sign };
  Kind kind = Kind::end;
  std::string_view text;  ///< of strings without quotes

  bool is(char c) const { return kind == Kind::sign && text[0] == c; }
};

/// Tokens as Gmsh reads them from a place on.
class Tokens {
 public:
  Tokens(std::string_view text, size_t at) : text_(text), at_(at) {}

  Token next() {
    skip();
    if (at_ >= text_.size()) return {};
    const char c = text_[at_];
    const size_t begin = at_;
    if (c == '"' || c == '\'') {
      at_ = std::min(text_.find(c, begin + 1), text_.size());
      const Token token{Token::Kind::string, text_.substr(begin + 1, at_ - begin - 1)};
      ++at_;
      return token;
    }
    if (is_word_part(c)) {
      while (at_ < text_.size() && is_word_part(text_[at_]))
        ++at_;
      return {is_letter(c) ? Token::Kind::word : Token::Kind::number,
              text_.substr(begin, at_ - begin)};
    }
    ++at_;
    return {Token::Kind::sign, text_.substr(begin, 1)};
  }

 private:
  void skip() {
    while (at_ < text_.size()) {
      if (std::string_view(" \t\n\r\f").find(text_[at_]) != std::string_view::npos) {
        ++at_;
      } else if (text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.substr(at_, 2) == "/*") {
        const size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  size_t at_;
};

bool opens(const Token& token) {
  return token.is('(') || token.is('[') || token.is('{');
}
bool closes(const Token& token) {
  return token.is(')') || token.is(']') || token.is('}');
}

/// That end in what is left.
int n_statements(Tokens tokens) {
  int n = 0;
  for (Token token = tokens.next(); token.kind != Token::Kind::end; token = tokens.next())
    n += token.is(';') ? 1 : 0;
  return n;
}

/// Passes what an opened parenthesis holds. @return whether it is closed within the statement
bool pass_parenthesis(Tokens& tokens) {
  for (int depth = 1; depth > 0;) {
    const Token token = tokens.next();
    if (token.kind == Token::Kind::end || token.is(';')) return false;
    if (opens(token)) ++depth;
    if (closes(token)) --depth;
  }
  return true;
}

/// Whether a string stands here that ends a command: quoted, or a name or function that gives one.
/// "Save it. Merge both (later)" in a comment holds none.
bool is_string(Tokens tokens) {
  const Token first = tokens.next();
  const bool is_quoted = first.kind == Token::Kind::string;
  if (is_quoted && first.text.size() > longest_name) return true;
  if (!is_quoted && first.kind != Token::Kind::word) return false;
  Token next = tokens.next();
  bool is_joined = false;  // behind '.' or ':', where another part of a name comes
  bool is_indexed = false;
  while (!is_quoted && !next.is(';')) {  // name[0], name~{1}, Options.Name, space::name, Str("x")
    const bool joins = next.is('.') || next.is(':') || next.is('~');
    const bool is_part = (is_joined && next.kind == Token::Kind::word) ||
                         (is_indexed && next.kind == Token::Kind::string);  // Save View[0] "x"
    is_indexed = opens(next) && pass_parenthesis(tokens);
    if (!joins && !is_part && !is_indexed) return false;
    is_joined = joins;
    next = tokens.next();
  }
  return next.is(';');
}

/// Whether > stands behind the parentheses that open here.
bool is_redirected(Tokens tokens) {
  return opens(tokens.next()) && pass_parenthesis(tokens) && tokens.next().is('>');
}

/// Whether = stands here, and not ==.
bool is_given_a_value(Tokens tokens) {
  return tokens.next().is('=') && !tokens.next().is('=');
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

/// A .geo file and what it takes in.
class Scan {
 public:
  explicit Scan(const std::string& path)
      : folder_(fs::weakly_canonical(fs::absolute(path)).parent_path()) {
    add(path);
    // what is taken in is added behind while the list is gone through
    for (size_t i = 0; i < files_.size(); ++i)
      check(files_[i]);
  }

  bool uses(std::string_view name) const {
    return std::any_of(files_.begin(), files_.end(), [&](const File& file) {
      const std::string text = msh::file_bytes(file.path.string());
      Tokens tokens(text, 0);
      for (Token token = tokens.next(); token.kind != Token::Kind::end; token = tokens.next()) {
        if (token.kind == Token::Kind::word && token.text == name && !is_given_a_value(tokens))
          return true;
      }
      return false;
    });
  }

  std::vector<std::string> files_read() const { return {read_.begin(), read_.end()}; }

 private:
  struct File {
    std::string shown;  ///< as messages name it
    fs::path path;
  };

  void add(const fs::path& path) {
    const fs::path whole = fs::weakly_canonical(fs::absolute(path));
    if (!known_.insert(whole.string()).second) return;
    read_.insert(whole.string());
    files_.push_back({path.string(), whole});
    add_options(path);
  }

  /// Gmsh runs FILE.opt behind every FILE that it opens, as a script like any other.
  void add_options(const fs::path& path) {
    const fs::path options = path.string() + ".opt";
    std::error_code error;
    if (fs::exists(fs::symlink_status(options, error))) add(options);
  }

  void check(const File file) {
    const std::string text = msh::file_bytes(file.path.string());
    const auto refuse = [&](size_t at, const std::string& reason) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
      throw base::InputError(fmt::format("{}:{}: {}", file.shown, line, reason));
    };
    for (size_t at = text.find_first_of(std::string_view("\0\r", 2)); at != std::string::npos;
         at = text.find_first_of(std::string_view("\0\r", 2), at + 1)) {
      if (text.compare(at, 2, "\r\n") != 0)
        refuse(at, "a NUL or a carriage return without a line feed; a .geo file is plain text");
    }
    const size_t last_line = text.rfind('\n') + 1;  // 0 where there is but one
    if (n_statements(Tokens(text, last_line)) > 1)
      refuse(
          last_line,
          "the last line has several statements and no end of line behind it, so that Gmsh would "
          "leave some of them out; end it");
    for (const Word& word : words) {
      // No look at what stands before: behind the end of a branch Gmsh goes on inside a word.
      for (size_t at = text.find(word.text); at != std::string::npos;
           at = text.find(word.text, at + 1)) {
        const size_t behind = at + word.text.size();
        if (behind < text.size() && is_word_part(text[behind])) continue;
        const std::string reason = offence(file, text, word, at);
        if (!reason.empty()) refuse(at, reason);
      }
    }
  }

  /// What is wrong with a word at a place, or nothing.
  std::string offence(const File& file, std::string_view text, const Word& word, size_t at) {
    const Tokens tokens(text, at + word.text.size());
    const std::string forbidden = fmt::format(
        "{} {}, which a mesh may not (nor in a comment): mesh it yourself and give the "
        ".msh file",
        word.text, word.does);
    Tokens next = tokens;
    switch (word.rule) {
      case Rule::never:
        return forbidden;
      case Rule::command: {
        const bool waits = word.text == "Sleep" && next.next().kind == Token::Kind::number;
        return is_string(tokens) || waits ? forbidden : "";
      }
      case Rule::call:
        return next.next().is('(') ? forbidden : "";
      case Rule::redirect:
        return is_redirected(tokens) ? forbidden : "";
      case Rule::read:
        return is_string(tokens) ? offence_of_name(file, word, next.next()) : "";
      case Rule::list: {
        const Token open = next.next();
        return open.is('(') || open.is('[') ? offence_of_name(file, word, next.next()) : "";
      }
      case Rule::option:
        if (!next.next().is('=')) return "";
        if (at > 0 && is_letter(text[at - 1])) return forbidden;
        return offence_of_name(file, word, next.next());
    }
    return "";
  }

  /// A file that is read must be named by a plain string and stand below the folder of the .geo
  /// file; scripts are searched in turn.
  std::string offence_of_name(const File& file, const Word& word, const Token& name) {
    if (name.kind != Token::Kind::string || name.text.size() > longest_name) {
      return fmt::format(
          "the name behind {} is not a plain string in quotes, so that it is not known what is "
          "read; write the name out",
          word.text);
    }
    std::vector<fs::path> found;
    for (const fs::path& folder : {file.path.parent_path(), folder_}) {
      std::error_code error;
      const fs::path path = fs::weakly_canonical(folder / fs::path(std::string(name.text)), error);
      const bool is_there = fs::is_regular_file(path, error);
      // Gmsh looks from the folder of the file that it reads; in a macro that may be another one.
      const bool is_asked = folder == file.path.parent_path() || is_there;
      if (is_asked && !is_below(path, folder_)) {
        return fmt::format("{} \"{}\" reads a file from outside the folder {}: copy it there",
                           word.text, msh::shown(name.text, 200), folder_.string());
      }
      if (is_there) found.push_back(path);
    }
    if (found.empty()) {
      return fmt::format("{} \"{}\": there is no such file", word.text, msh::shown(name.text, 200));
    }
    for (const fs::path& path : found) {
      read_.insert(path.string());
      const std::string reason = word.rule == Rule::read ? take_in(word, path) : "";
      if (!reason.empty()) return reason;
    }
    return "";
  }

  std::string take_in(const Word& word, const fs::path& path) {
    static const std::set<std::string> shapes{".stl", ".step", ".stp", ".brep", ".iges", ".igs"};
    const std::string ending = path.extension().string();
    const bool is_script = word.text == "Include" || ending == ".geo" || ending == ".pos";
    if (is_script) {
      add(path);
      return files_.size() > most_files
                 ? fmt::format("more than {} files are read; write one .msh file", most_files)
                 : "";
    }
    add_options(path);
    if (shapes.count(ending) > 0) return "";
    // any other file is run as a script unless its first line says what it is
    if (ending == ".msh" && msh::file_bytes(path.string()).starts_with("$MeshFormat")) return "";
    return fmt::format(
        "{} \"{}\": not a file that a mesh may read; known: .geo, .pos, .msh (that begins with "
        "$MeshFormat), .stl, .step, .stp, .brep, .iges, .igs",
        word.text, path.filename().string());
  }

  fs::path folder_;
  std::set<std::string> known_, read_;
  std::vector<File> files_;
};

}  // namespace

void check_geo(const std::string& path) {
  Scan{path};
}

std::vector<std::string> files_read(const std::string& path) {
  return Scan(path).files_read();
}

bool uses_name(const std::string& path, std::string_view name) {
  return Scan(path).uses(name);
}

}  // namespace diptych::meshes
