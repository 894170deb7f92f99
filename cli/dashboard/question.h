#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/json.h"
#include "cli/output/query_output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Questions to a store, and their answers; docs/http-api.md describes all of them. An answer is a
/// function of the store and the question, without sockets or a clock.

using Parameters = std::map<std::string, std::string>;

/// Returns `otherwise` if the parameter is missing. BadInput if it is not a whole number within the
/// limits.
Expected<std::int64_t> integer_parameter(const Parameters& parameters, const std::string& name,
                                         std::int64_t otherwise, std::int64_t least,
                                         std::int64_t most);

struct Question {
  StoreReader& store;
  std::filesystem::path file;  ///< of the store
  Parameters parameters{};
  std::string id{};  ///< the id in the path: "c812", "e81200007", "r7", a kind of figure
  DesignId design{};
  /// Returns whether the client has disconnected. If empty, this is not checked.
  std::function<bool()> is_gone{};
  bool is_snapshot = false;  ///< see DashboardOptions

  /// Empty if the parameter is missing.
  const std::string& text(const std::string& name) const;
  Expected<std::int64_t> integer(const std::string& name, std::int64_t otherwise,
                                 std::int64_t least, std::int64_t most) const {
    return integer_parameter(parameters, name, otherwise, least, most);
  }
  /// The design in the parameter `design`; empty if it is missing.
  Expected<std::optional<DesignId>> design_parameter() const;
};

struct Answer {
  std::string type = "application/json";
  std::string body{};
  /// The answer never changes, whatever happens to the store.
  bool is_final = false;
};

/// The name of the store in a snapshot; its real path means nothing on another computer.
inline const std::filesystem::path kSomeStore = "STORE";

inline constexpr const char* kCsvType = "text/csv; charset=utf-8";
inline constexpr const char* kSvgType = "image/svg+xml; charset=utf-8";

/// {"v":1, ...}. The version changes if the meaning of a field changes, not if a field is added.
JsonObject answer_object();
inline Answer json_answer(const JsonObject& object, bool is_final = false) {
  return {.body = object.text() + "\n", .is_final = is_final};
}

/// Adds the columns of the rows, each as an array under its name.
void add_columns(JsonObject& object, const Rows& rows);

/// Runs one of our own statements, with kRecordLimits. The caller must not ask for more rows than
/// that.
Expected<Rows> rows_of(const Question& question, const std::string& sql);

/// NotFound if the store has no such design.
Expected<void> check_design(const Question& question);

}  // namespace swarmsmith::cli
