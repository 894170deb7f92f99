#include "storage/internal/reading.h"

#include <unistd.h>
#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "storage/answer.h"
#include "storage/internal/file_checks.h"
#include "storage/internal/held_file.h"
#include "storage/internal/real_run_reader.h"
#include "storage/internal/row_reader.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/schema.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

/// A file: URI in which every byte that could have another meaning is written as %XX.
std::string immutable_uri(const fs::path& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '/' || c == '.' || c == '-' || c == '_';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri + "?immutable=1";
}

}  // namespace

bool cannot_make_files(const fs::path& path) {
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  return ::access(folder.c_str(), W_OK) != 0;
}

/// A store in WAL mode needs a -shm file beside it. If none can be made and there is no pending
/// log, no program can be writing the store, so it is safe to read the file directly.
Expected<sqlite::Connection> connect_for_reading(const fs::path& path) {
  const bool still = cannot_make_files(path) && !has_pending_log(path);
  Connection connection =
      still ? Connection(immutable_uri(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI)
            : Connection(path.string(), SQLITE_OPEN_READONLY);
  if (auto only = check_only_name(connection, path); !only) return Unexpected(only.error());
  if (auto sound = check_database_file(connection, path); !sound) return Unexpected(sound.error());
  configure_reader(connection);
  return connection;
}

std::string digest_of_campaign(const Connection& connection, const StoredCampaign& campaign) {
  const Part part{.designs_before = campaign.designs_before, .designs = campaign.designs};
  Digest digest;
  digest.add(campaign.row.digest);
  for (const DesignRow& row : read_designs(connection, part)) {
    digest.add(row.id.value);
    digest.add(row.mission);
    digest.add(row.method);
    digest.add(row.repetition);
    digest.add(row.seed);
    digest.add(row.budget);
  }
  read_answer(connection, part, [&](const Row& row) { add_answer(digest, row); });
  return digest.hex();
}

std::string digest_of_store(const Connection& connection) {
  std::vector<std::string> digests;
  for (const StoredCampaign& campaign : read_campaigns(connection))
    digests.push_back(digest_of_campaign(connection, campaign));
  if (digests.size() == 1) return digests.front();
  std::ranges::sort(digests);
  Digest digest;
  for (const std::string& each : digests)
    digest.add(each);
  return digest.hex();
}

std::string lost_texts(const Connection& connection) {
  const auto lost = candidates_without_phrases(connection);
  if (lost.empty()) return {};
  return fmt::format(
      "candidates refer to phrases that do not exist, or their text is longer than a store's: {}",
      lost.size());
}

std::vector<std::string> faults_of(const sqlite::Connection& connection) {
  std::vector<std::string> faults;
  try {
    Statement check(connection, "PRAGMA integrity_check");
    while (check.step()) {
      if (check.text(0) != "ok") faults.push_back(check.text(0));
    }
    if (std::string changed = changed_rows(connection); !changed.empty())
      faults.push_back(std::move(changed));
    Statement foreign(connection,
                      "SELECT \"table\", parent, count(*) FROM pragma_foreign_key_check"
                      " GROUP BY \"table\", parent");
    while (foreign.step()) {
      faults.push_back(fmt::format("rows of {} refer to rows of {} that do not exist: {}",
                                   foreign.text(0), foreign.text(1), foreign.integer(2)));
    }
    if (std::string lost = lost_texts(connection); !lost.empty()) faults.push_back(std::move(lost));
    for (std::string& fault : faults_of_real_runs(connection))
      faults.push_back(std::move(fault));
  } catch (const sqlite::SqliteError& error) {
    faults.emplace_back(error.what());
  }
  return faults;
}

namespace {

std::function<void(const std::string&)>& check_listener() {
  static std::function<void(const std::string&)> listener;
  return listener;
}

}  // namespace

LongCheck::LongCheck(sqlite::Connection& connection, const fs::path& path)
    : connection_(connection), path_(path), until_(SteadyClock::now() + std::chrono::seconds(2)) {
  constexpr int kInstructions = 100'000;  // some milliseconds
  sqlite3_progress_handler(
      connection_.handle(), kInstructions,
      [](void* self) {
        static_cast<LongCheck*>(self)->look();
        return 0;
      },
      this);
}

LongCheck::~LongCheck() {
  sqlite3_progress_handler(connection_.handle(), 0, nullptr, nullptr);
}

void LongCheck::look() {
  if (is_told_ || SteadyClock::now() < until_) return;
  is_told_ = true;
  if (check_listener()) {
    check_listener()(
        fmt::format("checking all of {} ({} MB), which has changed since it was last closed",
                    path_.string(), connection_.file_size() >> 20U));
  }
}

void set_check_listener(std::function<void(const std::string&)> on_long_check) {
  check_listener() = std::move(on_long_check);
}

std::string older_schema_text(std::int64_t schema, const std::string& name) {
  return fmt::format(
      "this store has schema {}; `swarmsmith backup {} new.db` makes a copy with schema {}", schema,
      name, kSchemaVersion);
}

}  // namespace swarmsmith
