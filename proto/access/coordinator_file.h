#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A TOML file with the address of a running coordinator, which the coordinator writes in one step
/// when it starts, and removes when it ends normally. Workers read it again before each attempt to
/// connect, so that they find a coordinator that has moved (orchestration facts, 12). Nothing in it
/// is secret.
struct CoordinatorFile {
  std::string endpoint;  ///< tcp://HOST:PORT, as other hosts reach it
  /// The same with numeric addresses instead of this host's name, which other hosts may not know.
  std::vector<std::string> others{};
  std::string public_key;  ///< empty: connections are not encrypted
  /// Whether it is not encrypted, but can be reached from other hosts (--insecure).
  bool insecure_plaintext = false;
  std::int64_t pid = 0;
  std::string host;
  std::string started;  ///< wall-clock time for users: 2026-11-21T15:37:00Z
  std::string http;     ///< for metrics and health, if available: http://HOST:PORT

  friend bool operator==(const CoordinatorFile&, const CoordinatorFile&) = default;
};

std::string text_of(const CoordinatorFile& coordinator);
/// `file` is the file's name in errors. Returns the first error, with line and column.
Expected<CoordinatorFile> parse_coordinator_file(std::string_view text, const std::string& file);

/// Refuses a file that other users may write: they could send workers to another coordinator.
Expected<CoordinatorFile> read_coordinator_file(const std::filesystem::path& file);
/// Other users may read the file, unless the coordinator is on loopback without keys, where it
/// admits only its own user.
Expected<void> write_coordinator_file(const std::filesystem::path& file,
                                      const CoordinatorFile& coordinator);
/// Removes the file, unless another coordinator has written it meanwhile.
void remove_coordinator_file(const std::filesystem::path& file, const CoordinatorFile& ours);

/// The file beside the store: STORE.coordinator.
std::filesystem::path coordinator_file_of(const std::filesystem::path& store);
/// The current time as "2026-11-21T15:37:00Z".
std::string wall_clock_text();

}  // namespace swarmsmith
