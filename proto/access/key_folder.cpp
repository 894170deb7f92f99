#include "proto/access/key_folder.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "proto/access/allow_list.h"
#include "proto/access/key_file.h"
#include "proto/access/role_text.h"
#include "proto/access/secret_file.h"

namespace swarmsmith {
namespace {

constexpr const char* kListHead =
    R"(# Who may connect to the coordinator that has server.key: one [[client]] per key. A running
# coordinator reads this file again when it changes (and on SIGHUP), and disconnects a client that you removed.
#
#   name      its name in logs and in the store
#   role      "worker": only evaluates; "operator": pauses, resumes, cancels, gives more budget, reads;
#             "reader": only reads the status
#   key       its public key: the line `public` of its key file
#   expires   the last day of the key, in UTC: 2027-01-31 without quotes; may be left out
#
# `swarmsmith keygen --client NAME --role worker --expires 2027-01-31` makes a key and adds it here.
format = 1
)";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::filesystem::path home() {
  if (const std::string named = variable("HOME"); !named.empty()) return named;
  const struct passwd* user = getpwuid(geteuid());
  return user != nullptr ? user->pw_dir : "/";
}

/// Keeps other processes that add clients waiting until the destructor. A folder without locks, or
/// that cannot be read, is not locked: reading its files then gives the error.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

ClientKeyFile new_key(const std::string& name, Role role, const std::string& server_key) {
  return {.name = name, .role = role, .pair = make_key_pair(), .server_key = server_key};
}

AllowedClient entry_of(const ClientKeyFile& key) {
  return {.name = key.name,
          .role = key.role,
          .public_key = key.pair.public_key,
          .expires = std::nullopt};
}

Expected<void> make_folder(std::filesystem::path folder) {
  // "keys/" and "keys/." have "keys" as their parent, which would get the usual mode.
  while (folder.has_parent_path() && folder.has_relative_path() &&
         (!folder.has_filename() || folder.filename() == ".")) {
    folder = folder.parent_path();
  }
  std::error_code trouble;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), trouble);
  if (::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST) {
    struct stat status = {};
    if (stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
      if ((status.st_mode & 022U) == 0) return {};
      return bad_input(
          "other users can write into this folder; forbid it: chmod 700 " + folder.string(),
          folder.string());
    }
    return bad_input("this is not a folder", folder.string());
  }
  const std::string why = trouble ? trouble.message() : std::strerror(errno);
  const bool has_home = !variable("HOME").empty();
  return unexpected(ErrorKind::Unavailable,
                    "the folder cannot be made: " + why + "; name another one: swarmsmith keygen " +
                        "DIR" + (has_home ? "" : " (HOME is not set)"),
                    folder.string());
}

}  // namespace

KeyFolder default_key_folder() {
  if (const std::string named = variable("SWARMSMITH_KEYS"); !named.empty()) return {named};
  std::filesystem::path base = variable("XDG_CONFIG_HOME");
  // Its specification says that relative paths must be ignored.
  if (!base.is_absolute()) base = home() / ".config";
  return {base / "swarmsmith" / "keys"};
}

Expected<std::vector<std::filesystem::path>> make_key_folder(const KeyFolder& folder) {
  if (auto made = make_folder(folder.path); !made) return Unexpected(made.error());
  const KeyPair server = make_key_pair();
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  files.emplace_back(folder.server_key(), text_of_server_key(server));
  std::string list = kListHead;
  for (const std::string& role : kRoleNames) {
    const ClientKeyFile key = new_key(role, *role_of(role), server.public_key);
    files.emplace_back(folder.client_key(role), text_of(key));
    list += "\n" + text_of(entry_of(key));
  }
  files.emplace_back(folder.clients(), list);
  // All are checked before the first is written, so that an existing file leaves the folder
  // unchanged.
  for (const auto& [file, text] : files) {
    if (std::error_code ignored; !std::filesystem::exists(file, ignored)) continue;
    return unexpected(ErrorKind::Conflict,
                      "already exists, and keys are never overwritten; name another folder, or "
                      "add a client to this one with --client NAME",
                      file.string());
  }
  std::vector<std::filesystem::path> made;
  for (const auto& [file, text] : files) {
    if (auto written = write_new_file(file, text); !written) {
      // Otherwise the next call would find keys that belong to no list.
      for (const std::filesystem::path& other : made)
        ::unlink(other.c_str());
      return Unexpected(written.error());
    }
    made.push_back(file);
  }
  return made;
}

Expected<std::filesystem::path> add_client(const KeyFolder& folder, const NewClient& client) {
  if (!is_client_name(client.name)) {
    return bad_input(
        "a client's name must consist of at most 64 letters, digits, \".\", \"_\" and \"-\"",
        client.name);
  }
  // From reading the list until it is replaced.
  const FolderLock lock(folder.path);
  Expected<KeyPair> server = read_server_key(folder.server_key());
  if (!server) {
    Error error = server.error();
    if (error.kind == ErrorKind::NotFound) {
      error.message += "; `swarmsmith keygen " + folder.path.string() + "` makes a folder of keys";
    }
    return Unexpected(std::move(error));
  }
  Expected<std::string> text =
      read_private_file(folder.clients(), "list of clients", Privacy::Integral);
  if (!text) return Unexpected(text.error());
  const AllowListOrErrors list = parse_allow_list(*text, folder.clients().string());
  if (!list) return Unexpected(list.error().front());
  if (std::ranges::find(*list, client.name, &AllowedClient::name) != list->end()) {
    return unexpected(ErrorKind::Conflict,
                      "a client \"" + client.name + "\" already exists; choose another name",
                      folder.clients().string());
  }
  const ClientKeyFile key = new_key(client.name, client.role, server->public_key);
  AllowedClient entry = entry_of(key);
  entry.expires = client.expires;
  // The key file first: a key that is not in the list admits no client.
  const std::filesystem::path file = folder.client_key(client.name);
  if (auto written = write_new_file(file, text_of(key)); !written) {
    Error error = written.error();
    if (error.kind == ErrorKind::Conflict) {
      error.message +=
          "; this one is not in clients.toml: delete it, or choose another name for the client";
    }
    return Unexpected(std::move(error));
  }
  if (!text->empty() && text->back() != '\n') *text += '\n';
  const auto replaced = replace_file(folder.clients(), *text + "\n" + text_of(entry), 0600);
  if (!replaced) {
    ::unlink(file.c_str());
    return Unexpected(replaced.error());
  }
  return file;
}

}  // namespace swarmsmith
