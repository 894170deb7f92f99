#include "proto/access/find_coordinator.h"

#include <cstdlib>

#include "proto/access/coordinator_file.h"
#include "proto/access/key_file.h"
#include "proto/socket.h"

namespace swarmsmith {
namespace {

/// `server_key`: the coordinator's key in its file; empty: not known.
Expected<FoundCoordinator> with_key(const CoordinatorSearch& search, const std::string& endpoint,
                                    const std::string& server_key) {
  const bool own = !search.key.empty();
  const std::filesystem::path file = own ? search.key : default_client_key(search.role);
  const Expected<ClientKeyFile> key = read_client_key(file);
  if (!key) {
    Error error = key.error();
    if (error.kind == ErrorKind::NotFound) {
      error.message += own ? ""
                           : ", and " + endpoint +
                                 " needs a key; copy the one that `swarmsmith keygen` made, or "
                                 "name another file with --key";
    }
    // A worker waits for a coordinator's file that is not there yet. But only a person can provide
    // a key, so its absence must end the worker.
    error.kind = ErrorKind::BadInput;
    return Unexpected(std::move(error));
  }
  if (!server_key.empty() && server_key != key->server_key) {
    return bad_input("this key is for another coordinator than the one in " + search.file.string() +
                         "; use a key from that coordinator's folder",
                     file.string());
  }
  return FoundCoordinator{.endpoint = endpoint, .keys = key->keys()};
}

Expected<FoundCoordinator> in_plaintext(const CoordinatorSearch& search,
                                        const std::string& endpoint) {
  if (!search.key.empty()) {
    return bad_input("the coordinator does not encrypt, but a key was given; leave out --key",
                     search.file.string());
  }
  return FoundCoordinator{.endpoint = endpoint, .keys = std::nullopt};
}

bool is_on_loopback(const std::string& endpoint) {
  const auto address = address_of(endpoint);
  return address && is_loopback(address->host);
}

}  // namespace

std::filesystem::path default_client_key(const std::string& role) {
  const char* named = std::getenv("SWARMSMITH_KEY");
  if (named != nullptr && *named != '\0') return named;
  return default_key_folder().client_key(role);
}

Expected<FoundCoordinator> find_coordinator(const CoordinatorSearch& search) {
  if (!search.endpoint.empty()) {
    const bool plain = search.insecure_plaintext || is_on_loopback(search.endpoint);
    if (search.key.empty() && plain) return in_plaintext(search, search.endpoint);
    return with_key(search, search.endpoint, "");
  }
  const Expected<CoordinatorFile> file = read_coordinator_file(search.file);
  if (!file) return Unexpected(file.error());
  const auto with_others = [&](Expected<FoundCoordinator> found) {
    if (found) found->others = file->others;
    return found;
  };
  if (!file->public_key.empty())
    return with_others(with_key(search, file->endpoint, file->public_key));
  if (!search.insecure_plaintext && !is_on_loopback(file->endpoint)) {
    return bad_input(
        "this coordinator does not encrypt; start it with keys (`swarmsmith keygen`), or accept it "
        "with --insecure-plaintext",
        search.file.string());
  }
  return with_others(in_plaintext(search, file->endpoint));
}

}  // namespace swarmsmith
