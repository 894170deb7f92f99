#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "storage/store.h"
#include "tests/support/synthetic_campaign.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {

inline std::unique_ptr<Store> open_store(const std::filesystem::path& path,
                                         const SyntheticCampaign& campaign,
                                         const StoreOptions& options = {}) {
  auto store = Store::open(path, campaign.campaign, campaign.designs, options);
  EXPECT_TRUE(store) << (store ? "" : to_string(store.error()));
  return store ? std::move(*store) : nullptr;
}

inline std::unique_ptr<StoreReader> open_reader(const std::filesystem::path& path) {
  auto reader = StoreReader::open(path);
  EXPECT_TRUE(reader) << (reader ? "" : to_string(reader.error()));
  return reader ? std::move(*reader) : nullptr;
}

inline std::string digest_of(const std::filesystem::path& path) {
  return open_reader(path)->digest();
}

/// The digest of a store into which these batches were written, in this order.
inline std::string digest_after(const SyntheticCampaign& campaign,
                                const std::vector<std::vector<Row>>& batches) {
  const TemporaryFolder folder;
  {
    auto store = open_store(folder / "s.db", campaign);
    for (const auto& batch : batches)
      store->append(batch);
  }
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
