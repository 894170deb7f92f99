#pragma once

#include <sys/types.h>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "cli/dashboard/dashboard.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Readers of the stores that stay open, kept from one answer to the next: opening one takes SQLite
/// some milliseconds, most of an answer, to read what tables and views there are. Of other stores
/// none is kept: while it is open, its writer cannot fold the log into the file at its end.
class StoreReaders {
 public:
  using Reader = std::unique_ptr<StoreReader, std::function<void(StoreReader*)>>;

  Expected<Reader> take(const DashboardStore& store);

 private:
  using File = std::pair<dev_t, ino_t>;
  struct Kept {
    std::filesystem::path name;
    File file;
    std::unique_ptr<StoreReader> reader;
  };
  /// Of all stores: as many as answers are made at the same time, mostly.
  static constexpr std::size_t kMost = 4;

  Reader lent(StoreReader* reader, const std::filesystem::path& name, File file);

  std::mutex mutex_;
  std::vector<Kept> kept_;
};

/// Says whether a store's files have changed, without opening them. Empty while they change: the
/// clock of files is too coarse to tell what comes next.
std::string stamp_of(const std::filesystem::path& file);

}  // namespace swarmsmith::cli
