#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A host that ssh reaches, and its settings that differ from the defaults.
struct SshHost {
  std::string name;        ///< in the form that ssh accepts: host, user@host, or an alias from
                           ///< ssh's configuration
  std::int64_t slots = 0;  ///< 0: the CPUs that the worker finds
  std::filesystem::path program;      ///< empty: the same path as on this host
  std::filesystem::path key;          ///< empty: the same path as on this host
  std::filesystem::path coordinator;  ///< empty: the same path as on this host

  friend bool operator==(const SshHost&, const SshHost&) = default;
};

/// The hosts, or all errors in their file: `where` is file:line:column.
using HostsOrErrors = tl::expected<std::vector<SshHost>, std::vector<Error>>;

/// A host file has one host per line, `host [slots=N] [program=PATH] [key=PATH]
/// [coordinator=PATH]`, and comments that begin with #. Duplicate hosts and an empty file are
/// errors.
HostsOrErrors parse_hosts(std::string_view text, const std::filesystem::path& file);
HostsOrErrors read_hosts(const std::filesystem::path& file);

}  // namespace swarmsmith
