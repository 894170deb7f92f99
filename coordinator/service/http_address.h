#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/address.h"
#include "base/expected.h"

namespace swarmsmith {

/// Whether a request's Host header means us, and not another name that points at us (DNS
/// rebinding): on loopback, its names and numbers; elsewhere the name that we listen on, this
/// host's name, and any number, since browsers do not look numbers up.
bool is_our_host(std::string_view header, const Address& address, const std::string& host_name);

/// The token in a file that only its owner can read; one line of at least 16 characters.
Expected<std::string> read_token(const std::filesystem::path& file);

/// Whether an Authorization header carries the token; takes as long for any that does not.
bool has_token(std::string_view header, std::string_view token);

}  // namespace swarmsmith
