#pragma once

#include <concepts>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>

namespace swarmsmith {

/// JSON in the form that all programs of the project write: on one line, without blanks, keys in
/// the order in which they are added. nlohmann's writer is only for JSON whose exact text does not
/// matter: it writes 1.0 for 1, while the bytes of `--json` are guaranteed.

/// A text in quotes. Each byte that is not UTF-8 becomes U+FFFD.
std::string json_text(std::string_view text);
/// A number in the shortest form that reads back to the same value; null for values that JSON
/// lacks.
std::string json_number(double value);

/// A text that is already JSON.
struct JsonPiece {
  std::string text;
};

template <class T>
std::string json_of(const T& value);

/// An object that is built key by key.
class JsonObject {
 public:
  template <class T>
  JsonObject& add(std::string_view key, const T& value) {
    text_ += (text_.size() == 1 ? "" : ",") + json_text(key) + ":" + json_of(value);
    return *this;
  }
  std::string text() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

/// An array of the results of `of` for each item.
template <std::ranges::input_range Items, class Of>
JsonPiece json_list(const Items& items, const Of& of) {
  std::string text = "[";
  for (const auto& item : items)
    text += (text.size() == 1 ? "" : ",") + json_of(of(item));
  return {text + "]"};
}

/// Any value: booleans, numbers, texts, optional values (null if empty), ids (null for none), maps
/// with texts as keys, and ranges of these.
template <class T>
std::string json_of(const T& value) {
  if constexpr (std::same_as<T, JsonPiece>) {
    return value.text;
  } else if constexpr (std::same_as<T, JsonObject>) {
    return value.text();
  } else if constexpr (std::same_as<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::integral<T>) {
    return std::to_string(value);
  } else if constexpr (std::floating_point<T>) {
    return json_number(value);
  } else if constexpr (std::convertible_to<const T&, std::string_view>) {
    return json_text(value);
  } else if constexpr (requires { typename T::mapped_type; }) {
    JsonObject object;
    for (const auto& [key, of_key] : value)
      object.add(key, of_key);
    return object.text();
  } else if constexpr (std::ranges::input_range<T>) {
    return json_list(value, std::identity()).text;
  } else if constexpr (requires { value.has_value(); }) {
    return value ? json_of(*value) : "null";
  } else {
    return value ? json_text(to_string(value)) : "null";
  }
}

}  // namespace swarmsmith
