#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith {

/// One [[client]] of clients.toml: who may connect to a coordinator, as what, and until when.
struct AllowedClient {
  std::string name;
  Role role = Role::Worker;
  std::string public_key;
  /// The last day on which the key is good, in UTC; nothing: for ever.
  std::optional<std::chrono::year_month_day> expires;

  friend bool operator==(const AllowedClient&, const AllowedClient&) = default;
};

using AllowList = std::vector<AllowedClient>;
/// A list, or everything that is wrong with it, each with file:line:column.
using AllowListOrErrors = tl::expected<AllowList, std::vector<Error>>;

/// `file` is the list's name in errors. Names and keys may be in it once.
AllowListOrErrors parse_allow_list(std::string_view text, const std::string& file);

/// The [[client]] as lines of the file.
std::string text_of(const AllowedClient& client);
/// A date as the file writes it: 2027-01-31.
std::string text_of(std::chrono::year_month_day date);
/// Nothing for what is not a date.
std::optional<std::chrono::year_month_day> date_of(std::string_view text);

/// The clients as a socket takes them, with those whose day is over by `now` marked.
std::vector<ListedClient> clients_at(const AllowList& list, std::chrono::sys_seconds now);

}  // namespace swarmsmith
