#include "storage/internal/file_checks.h"

#include <sys/vfs.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "base/environment.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kHeaderBytes = 100;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

constexpr std::string_view kWayOut =
    "take it from a backup, or let `swarmsmith recover` make a new store of what can be read";

std::uint64_t number_at(std::string_view header, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    value = value << 8U | static_cast<unsigned char>(header[at + i]);
  }
  return value;
}

Unexpected truncated(const std::filesystem::path& path, std::uint64_t has, std::uint64_t wants) {
  return unexpected(ErrorKind::Corrupt,
                    fmt::format("the store is truncated: it has {} bytes, and its header speaks of "
                                "{}; {}",
                                has, wants, kWayOut),
                    path.string());
}

}  // namespace

std::string damaged_text(const std::string& fault) {
  return fmt::format("the store is damaged: {}; {}", fault, kWayOut);
}

bool has_database_header(const sqlite::Connection& connection) {
  return connection.file_bytes(0, kMagic.size()) == kMagic;
}

Expected<void> check_database_file(const sqlite::Connection& connection,
                                   const std::filesystem::path& path) {
  const auto size = static_cast<std::uint64_t>(connection.file_size());
  if (size == 0) return {};
  const std::string header = connection.file_bytes(0, kHeaderBytes);
  if (header.substr(0, kMagic.size()) != kMagic.substr(0, header.size())) {
    return unexpected(
        ErrorKind::Corrupt,
        "not a store: the file is not an SQLite database; name another path, or move the file away",
        path.string());
  }
  if (header.size() < kHeaderBytes) return truncated(path, size, kHeaderBytes);
  if (has_pending_log(connection.file())) return {};
  // https://www.sqlite.org/fileformat2.html#the_database_header: 1 stands for 65536, and the page
  // count holds when both change counters agree.
  const std::uint64_t page = number_at(header, 16, 2) == 1 ? 65536 : number_at(header, 16, 2);
  const std::uint64_t pages = number_at(header, 28, 4);
  const bool count_holds = number_at(header, 24, 4) == number_at(header, 92, 4);
  if (count_holds && size < page * pages) return truncated(path, size, page * pages);
  return {};
}

bool is_network_file_system(long type) {
  // f_type is signed on some machines; the magic numbers of linux/magic.h and statfs(2) are not.
  constexpr std::array<std::uint32_t, 13> kShared{
      0x6969,      // NFS
      0x517b,      // SMB
      0xff534d42,  // CIFS
      0xfe534d42,  // SMB2
      0x0bd00bd0,  // Lustre
      0x65735546,  // FUSE: sshfs, GlusterFS, ...
      0x00c36400,  // Ceph
      0x47504653,  // GPFS
      0x19830326,  // BeeGFS
      0x5346414f,  // AFS
      0x73757245,  // Coda
      0x01021997,  // 9P
      0x7461636f,  // OCFS2
  };
  return std::find(kShared.begin(), kShared.end(), static_cast<std::uint32_t>(type)) !=
         kShared.end();
}

Expected<void> check_folder(const std::filesystem::path& store) {
  const std::filesystem::path folder =
      store.parent_path().empty() ? std::filesystem::path(".") : store.parent_path();
  std::error_code trouble;
  if (!std::filesystem::is_directory(folder, trouble)) {
    return bad_input(fmt::format("the folder {} does not exist; make it first", folder.string()),
                     store.string());
  }
  if (std::filesystem::is_directory(store, trouble)) {
    return bad_input("this is a folder; a store is a file", store.string());
  }
  if (environment("SWARMSMITH_ALLOW_NETWORK_FS") == "1") return {};
  struct statfs about {};
  if (::statfs(folder.c_str(), &about) == 0 && is_network_file_system(about.f_type)) {
    return bad_input(
        "the folder is on a network file system, where a store can be damaged by a second writer; "
        "put it on a local disk and copy it afterwards, or set SWARMSMITH_ALLOW_NETWORK_FS=1 when "
        "only one host will ever touch it",
        store.string());
  }
  return {};
}

bool has_pending_log(const std::filesystem::path& store) {
  std::error_code trouble;
  const auto size = std::filesystem::file_size(store.string() + "-wal", trouble);
  return !trouble && size > 0;
}

}  // namespace swarmsmith
