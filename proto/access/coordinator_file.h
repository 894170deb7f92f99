#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// Where a running coordinator is found: a TOML file that it writes when it starts, in one step,
/// and takes away when it ends in order. Workers read it again before each try to connect, so that
/// a coordinator that moved is found (orchestration facts, 12). Nothing in it is secret.
struct CoordinatorFile {
  std::string endpoint;  ///< tcp://HOST:PORT, as other hosts reach it
  /// The same with numbers in place of this host's name, which other hosts may not know.
  std::vector<std::string> others{};
  std::string public_key;  ///< empty: connections are not encrypted
  /// Not encrypted and reachable from other hosts (--insecure).
  bool insecure_plaintext = false;
  std::int64_t pid = 0;
  std::string host;
  std::string started;  ///< wall-clock time for people: 2026-11-21T15:37:00Z
  std::string http;     ///< of metrics and health, if there are any: http://HOST:PORT

  friend bool operator==(const CoordinatorFile&, const CoordinatorFile&) = default;
};

std::string text_of(const CoordinatorFile& coordinator);
/// `file` is the file's name in errors, each with line and column; the first one.
Expected<CoordinatorFile> parse_coordinator_file(std::string_view text, const std::string& file);

/// Refuses a file that others may write: they could send workers elsewhere.
Expected<CoordinatorFile> read_coordinator_file(const std::filesystem::path& file);
/// Others may read it unless the coordinator is on loopback without keys, where it lets in only its
/// own user.
Expected<void> write_coordinator_file(const std::filesystem::path& file,
                                      const CoordinatorFile& coordinator);
/// Unless another coordinator has written it meanwhile.
void remove_coordinator_file(const std::filesystem::path& file, const CoordinatorFile& ours);

/// Beside the store: STORE.coordinator.
std::filesystem::path coordinator_file_of(const std::filesystem::path& store);
/// "2026-11-21T15:37:00Z", now.
std::string wall_clock_text();

}  // namespace swarmsmith
