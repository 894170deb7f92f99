#include "storage/internal/file_checks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/environment.h"
#include "base/mounts.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kHeaderBytes = 100;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

constexpr std::string_view kWayOut =
    "restore it from a backup, or let `swarmsmith recover` make a new store from what can be read";

std::uint64_t number_at(std::string_view header, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    value = value << 8U | static_cast<unsigned char>(header[at + i]);
  }
  return value;
}

Unexpected truncated(const std::filesystem::path& path, std::uint64_t has, std::uint64_t wants) {
  return unexpected(
      ErrorKind::Corrupt,
      fmt::format("the store is truncated: it has {} bytes, and its header says {}; {}", has, wants,
                  kWayOut),
      path.string());
}

constexpr std::uint32_t kFuse = 0x65735546;

/// FUSE programs that show a disk or a folder of this host: "fuse.bindfs".
bool is_local_program(std::string_view type) {
  // Not programs that join several folders (mergerfs, unionfs): the folders can be anywhere.
  constexpr std::array<std::string_view, 18> kLocal{
      "apfs",  "bindfs",    "cryfs",          "encfs",    "exfat",     "exfat-fuse",
      "ext2",  "fuse-ext2", "fuse-overlayfs", "fuse2fs",  "fuseext2",  "gocryptfs",
      "lxcfs", "ntfs",      "ntfs-3g",        "securefs", "veracrypt", "zfs-fuse"};
  constexpr std::string_view kPrefix = "fuse.";
  return type.starts_with(kPrefix) &&
         std::find(kLocal.begin(), kLocal.end(), type.substr(kPrefix.size())) != kLocal.end();
}

/// The mount of a file, found by its number, since the device of a file may differ from that of its
/// mount.
std::optional<Mount> mount_of(const std::filesystem::path& path) {
  struct statx about {};
  if (::statx(AT_FDCWD, path.c_str(), 0, STATX_MNT_ID, &about) != 0) return std::nullopt;
  if ((about.stx_mask & STATX_MNT_ID) == 0) return std::nullopt;
  for (Mount& mount : mounts())
    if (static_cast<std::uint64_t>(mount.id) == about.stx_mnt_id) return std::move(mount);
  return std::nullopt;
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
  // https://www.sqlite.org/fileformat2.html#the_database_header: 1 means 65536, and the page count
  // is valid when both change counters agree.
  const std::uint64_t page = number_at(header, 16, 2) == 1 ? 65536 : number_at(header, 16, 2);
  const std::uint64_t pages = number_at(header, 28, 4);
  const bool count_holds = number_at(header, 24, 4) == number_at(header, 92, 4);
  if (count_holds && size < page * pages) return truncated(path, size, page * pages);
  return {};
}

std::string kind_of_shared(long type, std::string_view name) {
  // f_type is signed on some machines; the magic numbers of linux/magic.h and statfs(2) are not.
  constexpr std::array<std::uint32_t, 12> kShared{
      0x6969,      // NFS
      0x517b,      // SMB
      0xff534d42,  // CIFS
      0xfe534d42,  // SMB2
      0x0bd00bd0,  // Lustre
      0x00c36400,  // Ceph
      0x47504653,  // GPFS
      0x19830326,  // BeeGFS
      0x5346414f,  // AFS
      0x73757245,  // Coda
      0x01021997,  // 9P
      0x7461636f,  // OCFS2
  };
  const auto magic = static_cast<std::uint32_t>(type);
  if (magic == kFuse) {
    if (name == "fuseblk" || is_local_program(name)) return {};
    if (name.empty() || name == "fuse") return "a FUSE file system of an unknown kind";
    return fmt::format("{}, a FUSE file system that is not known to be of this host alone", name);
  }
  if (std::find(kShared.begin(), kShared.end(), magic) == kShared.end()) return {};
  return name.empty() ? "a network file system" : fmt::format("{}, a network file system", name);
}

std::string shared_file_system(const std::filesystem::path& path) {
  std::filesystem::path place = path;
  std::string shown;  // names the FUSE program if it shows a folder of another file system
  // If a folder is mounted over itself, the folder below cannot be examined.
  constexpr int kMostLayers = 8;
  for (int layer = 0; layer < kMostLayers; ++layer) {
    struct statfs about {};
    if (::statfs(place.c_str(), &about) != 0) return {};
    const std::optional<Mount> mount = mount_of(place);
    const std::string type = mount ? mount->type : "";
    std::error_code none;
    const bool shows_folder = static_cast<std::uint32_t>(about.f_type) == kFuse && mount &&
                              mount->source.starts_with('/') &&
                              std::filesystem::path(mount->source) != mount->point &&
                              std::filesystem::is_directory(mount->source, none);
    // bindfs tells the folder that it shows, but not its own name.
    const bool says_no_more = shows_folder && type == "fuse";
    const std::string kind = says_no_more ? "" : kind_of_shared(about.f_type, type);
    if (!kind.empty()) return kind + shown;
    if (!shows_folder) return {};
    place = mount->source;
    shown = fmt::format(", which {} shows", mount->type);
  }
  return {};
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
  if (const std::string kind = shared_file_system(folder); !kind.empty()) {
    return bad_input(
        fmt::format(
            "the folder is on {}: if several hosts share it, a second writer can damage the "
            "store; put it on a local disk and copy it afterwards, or set "
            "SWARMSMITH_ALLOW_NETWORK_FS=1 when only one host will ever touch it",
            kind),
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
