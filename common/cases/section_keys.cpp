#include "common/cases/section_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace diptych::cases {

KeyText one_of(const std::vector<std::string>& menu,
               const std::string& meaning,
               const std::string& example,
               const std::string& need) {
  return {"-", any, meaning, example, need, "", menu};
}
KeyText as(KeyType type, KeyText text) {
  text.type = type;
  return text;
}
KeyText optional(KeyText text) {
  text.presence = Presence::optional;
  return text;
}
KeyText with_default(KeyText text) {
  text.presence = Presence::standard;
  return text;
}

Written written(const std::string& value) {
  return {KeyType::text, '"' + value + '"'};
}
Written written(bool value) {
  return {KeyType::flag, value ? "true" : "false"};
}
Written written(double value) {
  return {KeyType::number, fmt::format("{}", value)};
}
Written written(std::int64_t value) {
  return {KeyType::integer, fmt::format("{}", value)};
}
Written written(const std::vector<double>& value) {
  return {KeyType::numbers, fmt::format("{}", value)};
}
Written written(const std::vector<std::string>& value) {
  return {KeyType::groups, fmt::format("{}", value)};
}
Written written(const Vec3& value) {
  return {KeyType::vector, fmt::format("[{}, {}, {}]", value[0], value[1], value[2])};
}
Written written(const functions::Expression&) {
  return {KeyType::scalar_field, "0"};
}
Written written(const functions::VectorExpression&) {
  return {KeyType::vector_field, "[0, 0, 0]"};
}
Written written(const functions::TensorExpression&) {
  return {KeyType::tensor_field, ""};
}

Key key_of_text(const std::string& path, KeyType type, std::string standard, const KeyText& text) {
  const bool takes_name = !text.menu.empty();
  const Presence presence =
      text.presence.value_or(text.need.empty() ? Presence::standard : Presence::required);
  if (presence != Presence::standard) standard.clear();
  return {path,         text.type.value_or(takes_name ? KeyType::name : type),
          presence,     text.unit,
          standard,     text.need,
          text.range,   text.menu,
          text.meaning, text.example,
          text.advice};
}

}  // namespace diptych::cases
