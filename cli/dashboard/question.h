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

/// What is asked of a store, and what comes of it: docs/http-api.md tells all of them. An answer is
/// a function of the store and the question; no socket, no clock.

using Parameters = std::map<std::string, std::string>;

/// BadInput when the parameter is not a whole number within the limits; `otherwise` without it.
Expected<std::int64_t> integer_parameter(const Parameters& parameters, const std::string& name,
                                         std::int64_t otherwise, std::int64_t least,
                                         std::int64_t most);

struct Question {
  StoreReader& store;
  std::filesystem::path file;  ///< of the store
  Parameters parameters{};
  std::string id{};  ///< of the thing in the path: "c812", "e81200007", "r7", a kind of figure
  DesignId design{};
  /// Whether the client has disconnected since; empty: is never asked.
  std::function<bool()> is_gone{};
  bool is_snapshot = false;  ///< see DashboardOptions

  /// Empty without it.
  const std::string& text(const std::string& name) const;
  Expected<std::int64_t> integer(const std::string& name, std::int64_t otherwise,
                                 std::int64_t least, std::int64_t most) const {
    return integer_parameter(parameters, name, otherwise, least, most);
  }
  /// The design of the parameter `design`; none without it.
  Expected<std::optional<DesignId>> design_parameter() const;
};

struct Answer {
  std::string type = "application/json";
  std::string body{};
  /// It stays as it is, whatever becomes of the store.
  bool is_final = false;
};

/// What a snapshot calls its store, whose name says nothing to who reads it elsewhere.
inline const std::filesystem::path kSomeStore = "STORE";

inline constexpr const char* kCsvType = "text/csv; charset=utf-8";
inline constexpr const char* kSvgType = "image/svg+xml; charset=utf-8";

/// {"v":1, ...}: a new field does not change the version, a new meaning does.
JsonObject answer_object();
inline Answer json_answer(const JsonObject& object, bool is_final = false) {
  return {.body = object.text() + "\n", .is_final = is_final};
}

/// The columns of the rows, each an array under its name.
void add_columns(JsonObject& object, const Rows& rows);

/// Statements of our own: rows that no page shows in full are the caller's mistake.
Expected<Rows> rows_of(const Question& question, const std::string& sql);

/// NotFound when the store has no such design.
Expected<void> check_design(const Question& question);

}  // namespace swarmsmith::cli
