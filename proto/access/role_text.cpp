#include "proto/access/role_text.h"

#include <algorithm>

namespace swarmsmith {

std::optional<Role> role_of(std::string_view name) {
  if (name == "worker") return Role::Worker;
  if (name == "operator") return Role::Operator;
  if (name == "reader") return Role::Reader;
  return std::nullopt;
}

std::string name_of(Role role) {
  switch (role) {
    case Role::Worker:
      return "worker";
    case Role::Operator:
      return "operator";
    case Role::Reader:
      return "reader";
    case Role::Anyone:
      break;
  }
  return "anyone";
}

bool is_client_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  constexpr std::string_view kSigns = "._-";
  const auto fits = [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kSigns.find(c) != std::string_view::npos;
  };
  return !name.empty() && name.size() <= kLongest && name.front() != '.' && name.front() != '-' &&
         std::ranges::all_of(name, fits) && name != "server" && name != "clients";
}

}  // namespace swarmsmith
