#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith {

/// One [[client]] of clients.toml: a client that may connect to a coordinator, with its role, and
/// until when.
struct AllowedClient {
  std::string name;
  Role role = Role::Worker;
  std::string public_key;
  /// The last day on which the key is valid, in UTC; empty: without limit.
  std::optional<std::chrono::year_month_day> expires;

  friend bool operator==(const AllowedClient&, const AllowedClient&) = default;
};

using AllowList = std::vector<AllowedClient>;
/// A list, or all errors in it, each with file:line:column.
using AllowListOrErrors = tl::expected<AllowList, std::vector<Error>>;

/// `file` is the list's name in errors. Each name and each key may be in the list only once.
AllowListOrErrors parse_allow_list(std::string_view text, const std::string& file);

/// The [[client]] as lines of the file.
std::string text_of(const AllowedClient& client);
/// A date as the file writes it: 2027-01-31.
std::string text_of(std::chrono::year_month_day date);
/// Empty for a text that is not a date.
std::optional<std::chrono::year_month_day> date_of(std::string_view text);

/// The clients in the form that a socket needs; those that have expired by `now` are marked.
std::vector<ListedClient> clients_at(const AllowList& list, std::chrono::sys_seconds now);

}  // namespace swarmsmith
