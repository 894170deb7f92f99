#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "cli/dashboard/question.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Parses the addresses of the API. Pure.

inline constexpr std::string_view kApi = "/api/v1/";

using Route = Expected<Answer> (*)(const Question&);

struct Pattern {
  /// The path below c1/: "designs/*/race"; * stands for an id.
  std::string_view path;
  Route route;
  bool is_heavy = false;
};

/// A question to a store: the function that answers it, and the id in the path.
struct Routed {
  const Pattern* pattern = nullptr;
  std::string id;
};

/// A command on a campaign or a design, sent by POST.
struct Act {
  std::size_t store = 0;
  DesignId design{};
  CommandKind kind = CommandKind::Unknown;
};

/// Removes the part before the next slash and returns it.
std::string_view next_part(std::string_view& path);
/// The index of the store with this name; "c1" is the first of `stores`.
std::optional<std::size_t> store_named(std::string_view name, std::size_t stores);
/// `path`: the part below c1/. Empty if there is no such path.
std::optional<Routed> route_of(std::string_view path);
/// `path`: the whole path. Empty if it is not a command.
std::optional<Act> act_of(std::string_view path, std::size_t stores);

}  // namespace swarmsmith::cli
