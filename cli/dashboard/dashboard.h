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

/// A store of the dashboard; the first one is c1.
struct DashboardStore {
  std::filesystem::path file;
  /// Its place among the campaigns of the coordinator that publishes; none: it is not run there.
  std::optional<std::size_t> place{};
  /// It is kept open between answers: this process writes it, or reads it once and ends.
  bool stays_open = false;
};

struct DashboardOptions {
  std::vector<DashboardStore> stores{};
  /// Carries out what a person asks of a campaign; a sentence that says what was done, when it is
  /// on disk. Empty: acts are refused.
  std::function<Expected<std::string>(const std::filesystem::path& store, const CommandRow&)> act{};
  /// The program that runs statements: `swarmsmith`.
  std::string program{};
  std::string version{};  ///< of this program
  /// For a file that is given away: it has nothing of this host, this process or this moment.
  bool is_snapshot = false;
  /// What is asked before each `live`: it may publish. Empty: nothing.
  std::function<void()> before_live{};
  /// A question that takes longer is answered 202, and fetched later. Less than a connection lives.
  std::chrono::milliseconds patience{5000};
};

/// The pages of the dashboard and what they ask for (docs/http-api.md).
std::shared_ptr<HttpSite> make_dashboard(DashboardOptions options);

/// Secret of 32 random bytes, as text.
std::string new_token();
/// Beside the store, for its owner alone: "demo.db.token".
std::filesystem::path token_file_of(const std::filesystem::path& store);
/// Writes it, mode 0600. Errors: Unavailable.
Expected<void> write_token(const std::filesystem::path& file, const std::string& token);

}  // namespace swarmsmith::cli
