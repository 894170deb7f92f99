#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "proto/role.h"

namespace swarmsmith {

/// The roles of keys, as files and commands write them.
inline const std::array<std::string, 3> kRoleNames = {"worker", "operator", "reader"};

/// Empty for any other name.
std::optional<Role> role_of(std::string_view name);
/// The role's name; "anyone" for a peer without a key.
std::string name_of(Role role);

/// Names of clients are also names of files: letters, digits, ".", "_" and "-", at most 64, not
/// beginning with a dot, and not "server" or "clients".
bool is_client_name(std::string_view name);

}  // namespace swarmsmith
