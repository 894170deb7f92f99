#include "cli/arguments/access_flags.h"

#include <unistd.h>
#include <utility>

#include "base/log.h"
#include "proto/access/address.h"
#include "proto/access/key_file.h"
#include "proto/access/key_folder.h"
#include "proto/socket.h"

namespace swarmsmith::cli {
namespace {

Error with_hint(Error error, const KeyFolder& folder, bool named) {
  if (error.kind != ErrorKind::NotFound) return error;
  error.message += "; `swarmsmith keygen" + (named ? " " + folder.path.string() : "") +
                   "` makes keys; without them no program on another host may connect";
  return error;
}

void log_faults(const std::vector<Error>& faults) {
  for (const Error& fault : faults) {
    log_event(LogLevel::Error, "coordinator",
              "new list of clients refused; the last one stays in use",
              {{"reason", to_string(fault)}});
  }
}

}  // namespace

void AccessFlags::declare(Options& options) {
  options.text("--keys DIR", keys,
               "Folder of `swarmsmith keygen`: connections are encrypted, and only clients in its "
               "clients.toml may connect (default beyond loopback: SWARMSMITH_KEYS, else "
               "~/.config/swarmsmith/keys)");
  options.flag("--insecure-plaintext", insecure_plaintext,
               "Listen beyond loopback without encryption, to any client");
  options.text("--coordinator-file FILE", coordinator_file,
               "File for the coordinator's address (default: STORE.coordinator)");
  options.text(
      "--advertise HOST", advertise,
      "Host name or address in this file (default: the address of --bind; for all interfaces this "
      "host's name, or its address where other hosts cannot use the name)");
}

tl::expected<Access, std::vector<Error>> open_access(const AccessFlags& flags,
                                                     const std::string& bind) {
  const auto address = address_of(bind);
  const bool beyond = address && !is_loopback(address->host);
  Access access;
  access.insecure_plaintext = flags.insecure_plaintext && beyond;
  if (flags.insecure_plaintext && !flags.keys.empty()) {
    return tl::unexpected(std::vector<Error>{
        {ErrorKind::BadInput, "--keys and --insecure-plaintext exclude each other", ""}});
  }
  if (flags.keys.empty() && (!beyond || flags.insecure_plaintext)) return access;
  const KeyFolder folder = flags.keys.empty() ? default_key_folder() : KeyFolder{flags.keys};
  const auto pair = read_server_key(folder.server_key());
  if (!pair) {
    return tl::unexpected(std::vector<Error>{with_hint(pair.error(), folder, !flags.keys.empty())});
  }
  auto list = AllowListFile::open(folder.clients(), AllowListWatch::system_time());
  if (!list) return tl::unexpected(std::move(list.error()));
  access.keys = ServerKeys{.secret_key = pair->secret_key, .clients = list->clients()};
  access.public_key = pair->public_key;
  access.local_key = folder.client_key("worker");
  access.watch = std::make_shared<AllowListWatch>(std::move(*list), log_faults);
  return access;
}

CoordinatorFile coordinator_file(const AccessFlags& flags, const Access& access,
                                 const std::string& endpoint) {
  return {.endpoint = advertised_endpoint(endpoint, flags.advertise),
          .others = advertised_numbers(endpoint, flags.advertise),
          .public_key = access.public_key,
          .insecure_plaintext = access.insecure_plaintext,
          .pid = getpid(),
          .host = name_of_this_host(),
          .started = wall_clock_text(),
          .http = {}};
}

}  // namespace swarmsmith::cli
