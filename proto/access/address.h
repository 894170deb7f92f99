#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/address.h"

namespace swarmsmith {

/// What a person types as the address of a coordinator: HOST:PORT, with or without tcp://. The
/// result is tcp://HOST:PORT. `with_port`: a port of 0 or * is refused.
Expected<std::string> endpoint_of(std::string_view text, bool with_port);

/// Where others find what listens at `endpoint`: with `advertise` in place of the host if it is not
/// empty. In place of a wildcard it has this host's name, if that is known here by a number that
/// others can reach, else such a number.
std::string advertised_endpoint(const std::string& endpoint, const std::string& advertise);
/// Where others find it, too, if they do not know that name: the numbers of this host.
std::vector<std::string> advertised_numbers(const std::string& endpoint,
                                            const std::string& advertise);
/// Where processes of this host find it.
std::string local_endpoint(const std::string& endpoint);

}  // namespace swarmsmith
