#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// Visitors of the fields of orders and states; this one writes them as JSON.

class JsonFieldWriter {
 public:
  template <class Value>
  void operator()(const char* key, const Value& value, bool is_written = true) {
    if (is_written) json_.add(key, as_json(value));
  }
  std::string text() const { return json_.text(); }

 private:
  template <class Value>
  static auto as_json(const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      return name_of(value);
    } else {
      return value;
    }
  }
  static JsonObject as_json(const PerFeed<std::optional<double>>& numbers) {
    JsonObject object;
    for (const Feed feed : kAllFeeds) {
      if (const auto number = numbers[index_of(feed)]) object.add(name_of(feed), *number);
    }
    return object;
  }
  static JsonObject as_json(const std::map<std::string, double>& numbers) {
    JsonObject object;
    for (const auto& [name, number] : numbers)
      object.add(name, number);
    return object;
  }

  JsonObject json_;
};

/// Reads the fields. Values that are missing or have another type are not changed.
class JsonFieldReader {
 public:
  using Json = nlohmann::json;

  explicit JsonFieldReader(const Json& json) : json_(json) {}

  template <class Value>
  void operator()(const char* key, Value& value, bool /*is_written*/ = true) {
    known_.insert(key);
    const auto found = json_.find(key);
    if constexpr (std::is_enum_v<Value>) {
      std::string name;
      if (found != json_.end()) read(*found, name);
      const auto known = named<Value>(name);
      if (known) {
        value = *known;
      } else if constexpr (std::is_same_v<Value, RunVerdict>) {
        value = RunVerdict::Invalid;
      } else if (found == json_.end()) {
        error_ = std::string("the key `") + key + "` is missing";
      } else {
        error_ = std::string("there is no ") + key + " `" + name + "`";
      }
    } else if (found != json_.end()) {
      read(*found, value);
    }
  }
  /// Empty: there is no error.
  const std::string& error() const { return error_; }
  /// A list such as "`sed`, `robot`".
  std::string unknown_keys() const {
    std::string text;
    for (const auto& [key, value] : json_.items()) {
      if (known_.count(key) == 0) text += (text.empty() ? "`" : ", `") + key + "`";
    }
    return text;
  }

 private:
  static void read(const Json& json, std::string& value) {
    if (json.is_string()) value = json;
  }
  static void read(const Json& json, bool& value) {
    if (json.is_boolean()) value = json;
  }
  static void read(const Json& json, std::int64_t& value) {
    if (json.is_number_integer()) value = json;
  }
  static void read(const Json& json, double& value) {
    if (json.is_number()) value = json;
  }
  template <class Value>
  static void read(const Json& json, std::optional<Value>& value) {
    if (std::is_integral_v<Value> ? json.is_number_integer() : json.is_number())
      value = json.get<Value>();
  }
  static void read(const Json& json, PerFeed<std::optional<double>>& values) {
    for (const Feed feed : kAllFeeds) {
      const std::string key(name_of(feed));
      if (json.contains(key)) read(json[key], values[index_of(feed)]);
    }
  }
  static void read(const Json& json, std::map<std::string, double>& values) {
    if (!json.is_object()) return;
    for (const auto& [name, number] : json.items()) {
      if (number.is_number()) values[name] = number.get<double>();
    }
  }
  static void read(const Json& json, std::vector<std::string>& values) {
    if (!json.is_array()) return;
    for (const Json& item : json) {
      if (item.is_string()) values.push_back(item.get<std::string>());
    }
  }

  const Json& json_;
  std::set<std::string> known_;
  std::string error_;
};

}  // namespace swarmsmith
