#pragma once
/// A named menu: ordinary object, filled by an explicit function, asked by name. A wrong name
/// answers with the nearest known ones.

#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych::base {

template <class Entry>
class Registry {
 public:
  /// @param kind what the entries are, for messages ("kernel", "limiter")
  explicit Registry(std::string kind) : kind_(std::move(kind)) {}

  /// @throws std::logic_error where the name stands already: a mistake in the program, and the
  ///         second entry could never be asked for
  Registry& add(std::string name, Entry entry) {
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
      throw std::logic_error(kind_ + " '" + name + "' stands twice in its menu");
    names_.push_back(std::move(name));
    entries_.push_back(std::move(entry));
    return *this;
  }

  const Entry& at(const std::string& name) const {
    for (size_t i = 0; i < names_.size(); ++i) {
      if (names_[i] == name) return entries_[i];
    }
    throw InputError("unknown " + kind_ + " '" + name + "'" + suggestion(name, names_));
  }

  const std::vector<std::string>& names() const { return names_; }

 private:
  std::string kind_;
  std::vector<std::string> names_;
  std::vector<Entry> entries_;
};

}  // namespace diptych::base
