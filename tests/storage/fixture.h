#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "storage/store.h"
#include "tests/support/checks.h"
#include "tests/support/synthetic_campaign.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {

inline std::unique_ptr<Store> open_store(const std::filesystem::path& path,
                                         const SyntheticCampaign& campaign,
                                         const StoreOptions& options = {}) {
  return value_of(Store::open(path, campaign.campaign, campaign.designs, options));
}

inline std::unique_ptr<StoreReader> open_reader(const std::filesystem::path& path) {
  return value_of(StoreReader::open(path));
}

inline std::string digest_of(const std::filesystem::path& path) {
  return open_reader(path)->digest();
}

/// The store again, with all rows of the campaign in it. They are on the disk when it is closed.
inline std::unique_ptr<Store> filled_store(const std::filesystem::path& path,
                                           const SyntheticCampaign& campaign) {
  auto store = open_store(path, campaign);
  for (const auto& batch : campaign.batches)
    store->append(batch);
  return store;
}

inline void fill_store(const std::filesystem::path& path, const SyntheticCampaign& campaign) {
  filled_store(path, campaign);
}

/// A store of a made-up campaign, open for reading.
struct FilledStore : ::testing::Test {
  TemporaryFolder folder;
  SyntheticCampaign campaign;
  std::unique_ptr<StoreReader> reader;

  explicit FilledStore(SyntheticCampaign made = synthetic_campaign({.designs = 2, .iterations = 3}))
      : campaign(std::move(made)) {
    fill_store(folder / "s.db", campaign);
    reader = open_reader(folder / "s.db");
  }
};

/// The digest of a store into which these batches were written, in this order.
inline std::string digest_after(const SyntheticCampaign& campaign,
                                const std::vector<std::vector<Row>>& batches) {
  const TemporaryFolder folder;
  fill_store(folder / "s.db", {campaign.campaign, campaign.designs, batches});
  return digest_of(folder / "s.db");
}

/// The cells of a query, row by row; NULL as "NULL".
inline std::vector<std::vector<std::string>> cells_of(StoreReader& reader, const std::string& sql) {
  std::vector<std::vector<std::string>> rows;
  const auto end = reader.query(
      sql, {}, [](const auto&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        rows.emplace_back();
        for (const auto& cell : cells) {
          rows.back().push_back(cell.type == StoreReader::Cell::Type::Null ? "NULL" : cell.text);
        }
      });
  EXPECT_TRUE(end) << (end ? "" : to_string(end.error()));
  return rows;
}

}  // namespace swarmsmith
