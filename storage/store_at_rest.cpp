#include "storage/store_at_rest.h"

#include <algorithm>
#include <functional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"
#include "storage/internal/open_writer.h"
#include "storage/internal/real_run_reader.h"
#include "storage/internal/real_run_writer.h"
#include "storage/internal/row_sums.h"
#include "storage/internal/row_writer.h"
#include "storage/internal/schema.h"
#include "storage/internal/schema_check.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;

constexpr char kCampaign[] =
    "INSERT INTO campaign (id, name, digest, deciding, file, seed, state, designs_before, finished)"
    " SELECT coalesce(max(id), 0) + 1, ?, ?, ?, ?, ?, 'imported', (SELECT count(*) FROM design),"
    " strftime('%Y-%m-%dT%H:%M:%fZ', 'now') FROM campaign";
constexpr char kDesign[] =
    "INSERT INTO design (id, mission, method, flavour, repetition, seed, budget, name, campaign)"
    " SELECT ?, ?, ?, ?, ?, ?, ?, ?, max(id) FROM campaign";

class SqliteAtRest final : public StoreAtRest {
 public:
  SqliteAtRest(Writer writer, fs::path path, bool is_new)
      : writer_(std::move(writer)), path_(std::move(path)), is_new_(is_new) {}

  ~SqliteAtRest() override {
    if (!is_new_) {
      give_up(writer_);
    } else if (writer_.file.fate().empty()) {  // while this process has the right to write it
      std::error_code ignored;
      for (const char* ending : {"", "-wal", "-shm"})
        fs::remove(path_.string() + ending, ignored);
    }
  }

  bool is_new() const override { return is_new_; }
  Expected<void> add(const Addition& addition) override;
  Expected<RealRunWritten> add_real_run(const RealRunRows& rows) override;
  Expected<void> rescore_real_run(RealRunId id, const RealRunRows& rows) override;
  Expected<void> add_override(const RealOverrideRow& row) override;

 private:
  /// Commits everything that `change` does, or nothing.
  Expected<void> in_one_go(const std::function<Expected<void>()>& change);
  Expected<void> check_candidate(CandidateId candidate) const;
  Expected<RealRunRows> stored_run(RealRunId id) const;
  Expected<void> add_campaign(const Addition& addition);

  Writer writer_;
  fs::path path_;
  bool is_new_;
};

Expected<void> SqliteAtRest::add(const Addition& addition) {
  for (const Row& row : addition.rows)
    require_finite(row);
  return in_one_go([&]() -> Expected<void> {
    if (auto added = add_campaign(addition); !added) return added;
    for (const auto& [name, text] : addition.profiles) {
      if (keep_profile(writer_.connection, name, text)) continue;
      return unexpected(ErrorKind::Conflict,
                        "the store has scores of another profile " + name +
                            ", which would be mixed up with these; give it another name",
                        path_.string());
    }
    RowWriter writer(writer_.connection);
    for (const EvaluationKey& key : addition.removed)
      writer.remove(key);
    for (const Row& row : addition.rows)
      writer.write(row);
    writer.write_sums({RowSums::Table::Campaign, RowSums::Table::Design});
    return {};
  });
}

Expected<void> SqliteAtRest::in_one_go(const std::function<Expected<void>()>& change) {
  try {
    sqlite::Transaction transaction(writer_.connection);
    if (is_new_) write_empty_store(writer_.connection);
    if (auto changed = change(); !changed) return changed;
    // No reader and no writer would open the store again, not even to repair it.
    if (const std::string text = too_long_text(writer_.connection); !text.empty())
      return bad_input(text + "; nothing was added: make it shorter", path_.string());
    if (auto sums = RowSums::stored(writer_.connection)) {
      for (const RowSums::Table table : RowSums::kOfRealRuns)
        sums->count(writer_.connection, table);
      sums->write(writer_.connection);
    }
    keep_sums(writer_.connection);
    transaction.commit();
  } catch (const sqlite::SqliteError& error) {
    return unexpected(
        ErrorKind::Unavailable,
        fmt::format("the store cannot be written: {}; nothing was added", error.what()),
        path_.string());
  }
  is_new_ = false;
  const std::string fate = writer_.file.fate();
  return fate.empty() ? Expected<void>() : Unexpected(save_lost(writer_, fate).error);
}

Expected<void> SqliteAtRest::check_candidate(CandidateId candidate) const {
  if (!candidate) return {};
  Statement known(writer_.connection, "SELECT 1 FROM candidate WHERE id = ?");
  known.bind(candidate.value);
  if (known.step()) return {};
  return unexpected(ErrorKind::NotFound, "the store has no candidate " + to_string(candidate),
                    path_.string());
}

Expected<RealRunRows> SqliteAtRest::stored_run(RealRunId id) const {
  if (auto rows = read_real_run(writer_.connection, id)) return std::move(*rows);
  return unexpected(ErrorKind::NotFound, "the store has no real run " + to_string(id),
                    path_.string());
}

Expected<RealRunWritten> SqliteAtRest::add_real_run(const RealRunRows& rows) {
  require_whole(rows);
  RealRunWritten written;
  const auto added = in_one_go([&]() -> Expected<void> {
    if (const auto known = real_run_of_key(writer_.connection, rows.key)) {
      written = {.id = *known, .is_new = false};
      const auto differ = differing_inputs(*read_real_run(writer_.connection, *known), rows);
      if (differ.empty()) return {};
      return unexpected(
          ErrorKind::Conflict,
          fmt::format("the run is stored as {}, with other inputs ({}); `swarmsmith track "
                      "rescore {}` scores it again from its stored sightings",
                      to_string(*known), fmt::join(differ, ", "), to_string(*known)),
          path_.string());
    }
    if (auto known = check_candidate(rows.candidate); !known) return known;
    if (is_new_) write_campaign_of_real_runs(writer_.connection, rows.key);
    written.id = write_real_run(writer_.connection, rows);
    return {};
  });
  if (!added) return Unexpected(added.error());
  return written;
}

Expected<void> SqliteAtRest::rescore_real_run(RealRunId id, const RealRunRows& rows) {
  require_whole(rows);
  return in_one_go([&]() -> Expected<void> {
    const auto stored = stored_run(id);
    if (!stored) return Unexpected(stored.error());
    if (!same_sightings(*stored, rows)) {
      return bad_input(fmt::format("the run to score again has other sightings than {}: other "
                                   "videos make a run of their own",
                                   to_string(id)),
                       path_.string());
    }
    if (const auto known = real_run_of_key(writer_.connection, rows.key); known && *known != id) {
      return unexpected(
          ErrorKind::Conflict,
          fmt::format("{} is that run, of the same videos with the same start", to_string(*known)),
          path_.string());
    }
    if (auto known = check_candidate(rows.candidate); !known) return known;
    rewrite_real_run(writer_.connection, id, rows);
    if (same_scoring(*stored, rows)) carry_overrides(writer_.connection, id);
    return {};
  });
}

Expected<void> SqliteAtRest::add_override(const RealOverrideRow& row) {
  if (std::ranges::find(kVerdicts, row.verdict) == kVerdicts.end()) {
    return bad_input(fmt::format("'{}' is not a verdict; use one of {}", row.verdict,
                                 fmt::join(kVerdicts, ", ")));
  }
  if (row.who.empty() || row.reason.empty()) {
    return bad_input(row.who.empty() ? "the person who overrides the verdict is not named"
                                     : "no reason is given to override the verdict");
  }
  return in_one_go([&]() -> Expected<void> {
    if (const auto stored = stored_run(row.run); !stored) return Unexpected(stored.error());
    write_override(writer_.connection, row);
    return {};
  });
}

Expected<void> SqliteAtRest::add_campaign(const Addition& addition) {
  if (!addition.campaign) return {};
  const CampaignRow& campaign = *addition.campaign;
  std::int64_t designs =
      sqlite::integer_of(writer_.connection, "SELECT coalesce(max(id), 0) FROM design");
  Statement(writer_.connection, kCampaign)
      .run(campaign.name, campaign.digest, campaign.deciding, campaign.file, campaign.seed);
  if (auto flavours = check_flavours(writer_.connection); !flavours)
    return Unexpected(flavours.error());
  know_flavours(writer_.connection);
  Statement insert(writer_.connection, kDesign);
  for (const auto& [row, name] : addition.designs) {
    if (row.id.value != ++designs) {
      return unexpected(
          ErrorKind::Conflict,
          fmt::format("design {} does not follow on d{}", to_string(row.id), designs - 1),
          path_.string());
    }
    insert.run(row.id.value, row.mission, row.method, row.flavour, row.repetition, row.seed,
               row.budget, name);
  }
  return {};
}

}  // namespace

Expected<std::unique_ptr<StoreAtRest>> StoreAtRest::open(const fs::path& named,
                                                         IfMissing if_missing,
                                                         const std::vector<DesignRow>& designs) {
  const fs::path path = real_store(named);
  std::error_code trouble;
  const bool exists = fs::exists(path, trouble);
  if (!exists && if_missing == IfMissing::Refuse) {
    return unexpected(ErrorKind::NotFound, "there is no such store", path.string());
  }
  if (auto folder = check_folder(path); !folder) return Unexpected(folder.error());
  try {
    auto writer = open_writer(path, {});
    if (!writer) return Unexpected(writer.error());
    const bool blank = is_blank(writer->connection);
    if (blank && exists && if_missing == IfMissing::Refuse) {
      return unexpected(ErrorKind::NotFound, "the file is empty: no campaign has begun in it",
                        path.string());
    }
    if (!blank) {
      migrate(writer->connection, path, migrations());
      name_flavours(writer->connection, designs);
      keep_sums(writer->connection);
    }
    writer->lock.set_suspect(false);
    return std::make_unique<SqliteAtRest>(std::move(*writer), path, blank);
  } catch (const sqlite::SqliteError& error) {
    return not_writable(error, path);
  }
}

}  // namespace swarmsmith
