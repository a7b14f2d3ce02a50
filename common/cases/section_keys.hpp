#pragma once
/// The keys of one section, each entry with the member of the section's struct that takes its
/// value: type and default follow from the member. Test: tests/common/cases/keys_test.cpp.

#include "common/cases/values.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace diptych::cases {

inline constexpr Range above(double least) {
  return {least, std::numeric_limits<double>::infinity(), false, false};
}
inline constexpr Range at_least(double least) {
  return {least, std::numeric_limits<double>::infinity(), true, false};
}
inline constexpr Range between(double least, double most) {
  return {least, most, true, true};
}

inline constexpr Range any{};

/// What an entry says besides its name and its member.
struct KeyText {
  std::string unit;
  Range range;
  std::string meaning, example;
  std::string need{};    ///< empty: there is a default
  std::string advice{};  ///< about a number out of range
  std::vector<std::string> menu{};
  std::optional<KeyType> type{};       ///< where it is not that of the member
  std::optional<Presence> presence{};  ///< where `need` does not tell: a need means "required"
};

/// One of these names.
KeyText one_of(const std::vector<std::string>& menu,
               const std::string& meaning,
               const std::string& example,
               const std::string& need = "");
/// The same where the member does not tell the type, or `need` not what holds without the key.
KeyText as(KeyType type, KeyText text);
KeyText optional(KeyText text);
KeyText with_default(KeyText text);

/// Of the types that a member may have: its type as a key, and its value as the file would write it
/// (fields are zero by default).
struct Written {
  KeyType type;
  std::string value;
};
Written written(const std::string& value);
Written written(bool value);
Written written(double value);
Written written(std::int64_t value);
Written written(const std::vector<double>& value);
Written written(const std::vector<std::string>& value);
Written written(const Vec3& value);
Written written(const functions::Expression& value);
Written written(const functions::VectorExpression& value);
Written written(const functions::TensorExpression& value);

/// The value of a key for a member of this type. @throws base::InputError
template <class Member>
Member value_of(const SectionValues& section, const std::string& name) {
  const KeyType type = section.type_of(name);
  if constexpr (std::is_same_v<Member, std::string>) {
    return type == KeyType::name ? section.menu_name(name) : section.text(name);
  } else if constexpr (std::is_same_v<Member, bool>) {
    return section.flag(name);
  } else if constexpr (std::is_same_v<Member, double>) {
    return section.number(name);
  } else if constexpr (std::is_same_v<Member, std::vector<double>>) {
    return section.numbers(name);
  } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
    return type == KeyType::texts ? section.texts(name) : section.groups(name);
  } else if constexpr (std::is_same_v<Member, Vec3>) {
    return section.vector(name);
  } else if constexpr (std::is_same_v<Member, functions::Expression>) {
    return section.scalar_field(name);
  } else if constexpr (std::is_same_v<Member, functions::VectorExpression>) {
    return section.vector_field(name);
  } else if constexpr (std::is_same_v<Member, functions::TensorExpression>) {
    return section.tensor_field(name, true);  // a deformation gradient: in 2-D of the plane
  } else {
    const std::int64_t number = section.integer(name);
    if (!std::in_range<Member>(number)) section.fail(name, "is too large");
    return static_cast<Member>(number);
  }
}

/// The entry of the table for this text. @param standard  of the member, if one takes the value
Key key_of_text(const std::string& path, KeyType type, std::string standard, const KeyText& text);

template <class Struct>
class SectionKeys {
 public:
  /// @param section  as in the table: "sph", "functions.*"; "" at the top of the file
  explicit SectionKeys(std::string section)
      : prefix_(section.empty() ? "" : std::move(section) + ".") {}

  /// A key whose value goes to a member, which holds its default.
  template <class Member>
  SectionKeys& key(const std::string& name, Member Struct::*member, const KeyText& text) {
    using Type = std::conditional_t<std::is_integral_v<Member> && !std::is_same_v<Member, bool>,
                                    std::int64_t, Member>;
    const Written standard = written(static_cast<Type>(Struct{}.*member));
    keys_.push_back(key_of_text(prefix_ + name, standard.type, standard.value, text));
    return bind(name, member);
  }
  /// The same of a member that may stay empty.
  template <class Member>
  SectionKeys& key(const std::string& name, std::optional<Member> Struct::*member, KeyText text) {
    text.need = "optional";
    text.presence = Presence::optional;
    keys_.push_back(key_of_text(prefix_ + name, written(Member{}).type, "", text));
    names_.push_back(name);
    takers_.push_back([name, member](const SectionValues& section, Struct& object) {
      if (section.has(name)) object.*member = value_of<Member>(section, name);
    });
    return *this;
  }
  /// A name that stands for a value of the program.
  template <class Member>
  SectionKeys& choice(const std::string& name,
                      Member Struct::*member,
                      const std::vector<std::pair<std::string, Member>>& choices,
                      KeyText text) {
    std::string standard;
    for (const auto& [word, value] : choices) {
      text.menu.push_back(word);
      if (value == Struct{}.*member) standard = written(word).value;
    }
    keys_.push_back(key_of_text(prefix_ + name, KeyType::name, standard, text));
    names_.push_back(name);
    takers_.push_back([name, member, choices](const SectionValues& section, Struct& object) {
      if (!section.has(name)) return;
      const std::string found = section.menu_name(name);
      for (const auto& [word, value] : choices) {
        if (word == found) object.*member = value;
      }
    });
    return *this;
  }
  /// A key that the section's own code reads.
  SectionKeys& key(const std::string& name, KeyType type, const KeyText& text) {
    keys_.push_back(key_of_text(prefix_ + name, type, "", text));
    names_.push_back(name);
    return *this;
  }
  /// The member for a key whose entry stands elsewhere.
  template <class Member>
  SectionKeys& bind(const std::string& name, Member Struct::*member) {
    names_.push_back(name);
    takers_.push_back([name, member](const SectionValues& section, Struct& object) {
      if (section.is_wanted(name)) object.*member = value_of<Member>(section, name);
    });
    return *this;
  }

  /// The entries that stand here, and the names of these and of bound keys.
  const std::vector<Key>& keys() const { return keys_; }
  const std::vector<std::string>& names() const { return names_; }

  /// The struct with what the file says, and defaults elsewhere.
  /// @throws base::InputError
  Struct read(const SectionValues& section) const {
    Struct object;
    for (const auto& taker : takers_)
      taker(section, object);
    return object;
  }

 private:
  std::string prefix_;
  std::vector<Key> keys_;
  std::vector<std::string> names_;
  std::vector<std::function<void(const SectionValues&, Struct&)>> takers_;
};

}  // namespace diptych::cases
