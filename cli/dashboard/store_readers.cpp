#include "cli/dashboard/store_readers.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <algorithm>
#include <chrono>
#include <exception>

#include <fmt/format.h>

namespace swarmsmith::cli {

Expected<StoreReaders::Reader> StoreReaders::take(const DashboardStore& store) {
  struct stat facts = {};
  const bool may_keep = store.stays_open && ::stat(store.file.c_str(), &facts) == 0;
  const File file{facts.st_dev, facts.st_ino};
  if (may_keep) {
    const std::scoped_lock lock(mutex_);
    // A different file with the same name is another store.
    std::erase_if(kept_,
                  [&](const Kept& kept) { return kept.name == store.file && kept.file != file; });
    const auto found = std::ranges::find(kept_, store.file, &Kept::name);
    if (found != kept_.end()) {
      StoreReader* const reader = found->reader.release();
      kept_.erase(found);
      return lent(reader, store.file, file);
    }
  }
  auto opened = StoreReader::open(store.file);
  if (!opened) return Unexpected(opened.error());
  if (may_keep) return lent(opened->release(), store.file, file);
  return Reader(opened->release(), std::default_delete<StoreReader>());
}

StoreReaders::Reader StoreReaders::lent(StoreReader* reader, const std::filesystem::path& name,
                                        File file) {
  return {reader, [this, name, file](StoreReader* back) {
            std::unique_ptr<StoreReader> returned(back);
            // After a disk failure, the state of the reader is not known.
            if (std::uncaught_exceptions() > 0) return;
            returned->rest();
            const std::scoped_lock lock(mutex_);
            if (kept_.size() < kMost) kept_.push_back({name, file, std::move(returned)});
          }};
}

std::string identity_of(const std::filesystem::path& file) {
  struct statx facts = {};
  if (::statx(AT_FDCWD, file.c_str(), 0, STATX_INO | STATX_BTIME, &facts) != 0) return "";
  // A file system may give the number of a deleted file to the next one, which began later.
  return fmt::format("{}.{}.{}.{}.{}", facts.stx_dev_major, facts.stx_dev_minor, facts.stx_ino,
                     facts.stx_btime.tv_sec, facts.stx_btime.tv_nsec);
}

std::string stamp_of(const std::filesystem::path& file) {
  constexpr auto kSettled = std::chrono::milliseconds(200);
  std::string stamp;
  for (const std::string& name : {file.string(), file.string() + "-wal"}) {
    struct stat facts = {};
    if (::stat(name.c_str(), &facts) != 0) {
      stamp += "-;";
      continue;
    }
    const auto changed = std::chrono::system_clock::time_point(
        std::chrono::duration_cast<std::chrono::system_clock::duration>(
            std::chrono::seconds(facts.st_mtim.tv_sec) +
            std::chrono::nanoseconds(facts.st_mtim.tv_nsec)));
    if (std::chrono::system_clock::now() - changed < kSettled) return "";
    stamp += fmt::format("{}.{}.{}.{};", facts.st_ino, facts.st_size, facts.st_mtim.tv_sec,
                         facts.st_mtim.tv_nsec);
  }
  return stamp;
}

}  // namespace swarmsmith::cli
