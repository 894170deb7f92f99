#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/address.h"
#include "base/expected.h"

namespace swarmsmith {

/// Whether a request's Host header names this server, and not another name that resolves to it (DNS
/// rebinding). On loopback, the valid names are the loopback names and numbers; elsewhere they are
/// the name that we listen on, this host's name, and any numeric address, since browsers do not
/// look numbers up.
bool is_our_host(std::string_view header, const Address& address, const std::string& host_name);

/// Reads the token from a file that only its owner can read; one line of at least 16 characters.
Expected<std::string> read_token(const std::filesystem::path& file);

/// Whether an Authorization header has the token; takes equally long for every wrong token.
bool has_token(std::string_view header, std::string_view token);

}  // namespace swarmsmith
