#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/address.h"

namespace swarmsmith {

/// The address of a coordinator as a user types it, HOST:PORT with or without tcp://, as
/// tcp://HOST:PORT. With `with_port`, a port of 0 or * is refused.
Expected<std::string> endpoint_of(std::string_view text, bool with_port);

/// The endpoint under which other hosts can reach a socket that listens at `endpoint`. Its host is
/// `advertise` if that is not empty. A wildcard is replaced by this host's name, if the name has an
/// address that others can reach, else by such an address.
std::string advertised_endpoint(const std::string& endpoint, const std::string& advertise);
/// The numeric addresses of this host at which others can also reach it, if they do not know that
/// name.
std::vector<std::string> advertised_numbers(const std::string& endpoint,
                                            const std::string& advertise);
/// The endpoint for processes of this host.
std::string local_endpoint(const std::string& endpoint);

}  // namespace swarmsmith
