#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/service/http_site.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// A store of the dashboard; the first store is c1.
struct DashboardStore {
  std::filesystem::path file;
  /// The index of the campaign in the status that the coordinator publishes; empty if the
  /// coordinator does not run it.
  std::optional<std::size_t> place{};
  /// The store stays open between answers, because this process writes it, or reads it once and
  /// ends.
  bool stays_open = false;
};

struct DashboardOptions {
  std::vector<DashboardStore> stores{};
  /// Carries out a user's command on a campaign. Returns a sentence that says what was done, once
  /// the command is on disk. If the function is empty, commands are refused.
  std::function<Expected<std::string>(const std::filesystem::path& store, const CommandRow&)> act{};
  /// The program that runs SQL statements: `swarmsmith`.
  std::string program{};
  std::string version{};  ///< of this program
  /// Makes a file for other people: it contains nothing about this host, this process or the
  /// current time.
  bool is_snapshot = false;
  /// Called before each `live`, so that it can publish a status. May be empty.
  std::function<void()> before_live{};
  /// A question that takes longer is answered with 202, and its answer is fetched later. Shorter
  /// than a connection may last.
  std::chrono::milliseconds patience{5000};
};

/// The pages of the dashboard and the answers to their questions (docs/http-api.md).
std::shared_ptr<HttpSite> make_dashboard(DashboardOptions options);

/// A secret of 32 random bytes, as text.
std::string new_token();
/// The token file beside the store, readable only by its owner: "demo.db.token".
std::filesystem::path token_file_of(const std::filesystem::path& store);
/// Writes the token file with mode 0600. Errors: Unavailable.
Expected<void> write_token(const std::filesystem::path& file, const std::string& token);

}  // namespace swarmsmith::cli
