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

/// Keeps readers open between answers, for the stores that stay open: opening a store takes SQLite
/// some milliseconds, most of the time of an answer, to read its tables and views. Readers of other
/// stores are not kept, because an open reader prevents the writer from folding the log into the
/// file when it ends.
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
  /// For all stores together: about as many as there are answers at the same time.
  static constexpr std::size_t kMost = 4;

  Reader lent(StoreReader* reader, const std::filesystem::path& name, File file);

  std::mutex mutex_;
  std::vector<Kept> kept_;
};

/// The identity of the file with this name: another one if the store was replaced by another store.
/// Empty if there is no such file.
std::string identity_of(const std::filesystem::path& file);

/// Shows whether a store's files have changed, without opening them. Empty while they are changing:
/// file times are too coarse to show the next change.
std::string stamp_of(const std::filesystem::path& file);

}  // namespace swarmsmith::cli
