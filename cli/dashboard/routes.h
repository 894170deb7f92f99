#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "cli/dashboard/question.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// What an address of the API asks for. Pure.

inline constexpr std::string_view kApi = "/api/v1/";

using Route = Expected<Answer> (*)(const Question&);

struct Pattern {
  /// Below c1/: "designs/*/race"; * is an id.
  std::string_view path;
  Route route;
  bool is_heavy = false;
};

/// A question to a store: who answers it, and the id in its path.
struct Routed {
  const Pattern* pattern = nullptr;
  std::string id;
};

/// What is asked of a campaign or a design by POST.
struct Act {
  std::size_t store = 0;
  DesignId design{};
  CommandKind kind = CommandKind::Unknown;
};

/// Cuts the part before the next slash off.
std::string_view next_part(std::string_view& path);
/// The place of the store that is named so, "c1" for the first of `stores`.
std::optional<std::size_t> store_named(std::string_view name, std::size_t stores);
/// `path`: below c1/. None: there is no such path.
std::optional<Routed> route_of(std::string_view path);
/// Of a whole path; none if it asks for no act.
std::optional<Act> act_of(std::string_view path, std::size_t stores);

}  // namespace swarmsmith::cli
