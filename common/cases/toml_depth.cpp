#include "common/cases/toml_depth.hpp"

#include "common/base/error.hpp"
#include "common/functions/expressions.hpp"

#include <fmt/format.h>
#include <string_view>

namespace diptych::cases {

namespace {

constexpr int most = 32;

/// Walks over the text once; of TOML it knows strings, comments, brackets and points.
class DepthScan {
 public:
  DepthScan(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        pass_string(c);
        continue;
      }
      if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n')
          ++at_;
        continue;
      }
      take(c);
      pass();
    }
  }

 private:
  void take(char c) {
    if (c == '.') {
      if (++n_parts_ > most) refuse("a key has");
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') {
      n_parts_ = 1;
    }
    if (c == '[' || c == '{') {
      if (++depth_ > most) refuse("values are nested");
    } else if ((c == ']' || c == '}') && depth_ > 0) {
      --depth_;
    }
  }

  void pass() {
    if (text_[at_] == '\n') {
      ++line_;
      line_begin_ = at_ + 1;
    }
    ++at_;
  }

  bool stands(std::string_view word) const { return text_.substr(at_, word.size()) == word; }

  /// A string of one line ends there at the latest, so that a missing quote hides nothing below.
  void pass_string(char quote) {
    const std::string triple(3, quote);
    const bool is_long = stands(triple);
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      const bool escapes = quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size();
      if (is_long && stands(triple)) {
        at_ += 3;
        while (at_ < text_.size() && text_[at_] == quote)
          ++at_;  // up to two more belong to the text
        return;
      }
      if (!is_long && text_[at_] == quote) {
        ++at_;
        return;
      }
      if (!is_long && text_[at_] == '\n') return;
      if (escapes) pass();
      pass();
    }
  }

  [[noreturn]] void refuse(const char* what) const {
    const functions::SourcePlace where{file_, line_, static_cast<int>(at_ - line_begin_) + 1};
    throw base::InputError(fmt::format("{}{} more than {} levels; no key of a case is that deep",
                                       functions::prefix(where), what, most));
  }

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0, line_begin_ = 0;
  int line_ = 1, depth_ = 0, n_parts_ = 1;
};

}  // namespace

void check_depth(const std::string& text, const std::string& file) {
  DepthScan(text, file).run();
}

}  // namespace diptych::cases
