#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A host that ssh reaches, and what is different there.
struct SshHost {
  std::string name;        ///< as ssh takes it: host, user@host, or an alias of its configuration
  std::int64_t slots = 0;  ///< 0: the CPUs that the worker finds
  std::filesystem::path program;      ///< empty: where this host has it
  std::filesystem::path key;          ///< empty: where this host has it
  std::filesystem::path coordinator;  ///< empty: where this host has it

  friend bool operator==(const SshHost&, const SshHost&) = default;
};

/// Hosts, or everything that is wrong with their file: `where` is file:line:column.
using HostsOrErrors = tl::expected<std::vector<SshHost>, std::vector<Error>>;

/// A host file has a line a host, `host [slots=N] [program=PATH] [key=PATH] [coordinator=PATH]`,
/// and comments from # on. A host that is named twice, and a file without hosts, are errors.
HostsOrErrors parse_hosts(std::string_view text, const std::filesystem::path& file);
HostsOrErrors read_hosts(const std::filesystem::path& file);

}  // namespace swarmsmith
