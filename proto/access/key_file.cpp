#include "proto/access/key_file.h"

#include <array>
#include <optional>

#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "proto/access/role_text.h"
#include "proto/access/secret_file.h"

namespace swarmsmith {
namespace {

constexpr const char* kWarning =
    "# Secret: anyone who reads this file can connect with it. Mode 0600; copy it with scp or on "
    "a\n"
    "# file system that others cannot read, never by mail or into a repository.\n";
constexpr const char* kServerRole = "server";

std::string key_line(const char* name, const std::string& value) {
  return std::string(name) + " = " + quoted_text(value) + "\n";
}

/// All fields of both kinds of key files.
struct Fields {
  std::string name;
  std::string role;
  KeyPair pair;
  std::string server_key;
};

std::string read_key(TableReader& table, const char* name) {
  if (!table.has(name)) {
    table.complain(name, "the file needs a key `" + std::string(name) + "`");
    return "";
  }
  const auto key = table.text(name);
  if (key && is_key(*key)) return *key;
  if (key) table.complain(name, "`" + std::string(name) + "` is not a key of 40 characters in Z85");
  return "";
}

/// Returns the first error. The parser's messages about text that is not TOML are left out, since
/// they may quote from the line.
Expected<Fields> parse_fields(std::string_view text, const std::string& file) {
  const auto document = parse_document(text, file);
  if (!document) {
    return bad_input("this is not a key file of `swarmsmith keygen`", document.error().where);
  }
  Complaints complaints(file);
  TableReader root(*document, "", complaints);
  read_format(root);
  static const std::array<std::string, 4> kRoles = {kServerRole, kRoleNames[0], kRoleNames[1],
                                                    kRoleNames[2]};
  Fields fields;
  if (!root.has("role")) root.complain("role", "the file needs a `role`");
  fields.role = root.choice("role", kRoles).value_or("");
  fields.pair.public_key = read_key(root, "public");
  fields.pair.secret_key = read_key(root, "secret");
  if (fields.role != kServerRole) {
    if (!root.has("name")) root.complain("name", "the file needs a `name`");
    fields.name = root.text("name").value_or("");
    fields.server_key = read_key(root, "server");
  }
  // An unknown key's text may be a secret, so it is not quoted.
  if (complaints.empty()) {
    Complaints unknown(file);
    TableReader rest(*document, "", unknown);
    for (const char* known : {"format", "role", "public", "secret", "name", "server"})
      rest.take(known);
    const auto more = rest.take_all();
    if (!more.empty()) {
      complaints.add(more.front().second->place, "a key file has no such key");
    } else if (public_key_of(fields.pair.secret_key) != fields.pair.public_key) {
      root.complain("public", "`public` does not belong to `secret`; is the file damaged?");
    }
  }
  if (!complaints.empty()) return Unexpected(complaints.take().front());
  return fields;
}

}  // namespace

std::string text_of(const ClientKeyFile& key) {
  return "# Key of the client \"" + key.name + "\" of a Swarmsmith coordinator.\n" + kWarning +
         "format = 1\n" + key_line("name", key.name) + key_line("role", name_of(key.role)) +
         key_line("public", key.pair.public_key) + key_line("secret", key.pair.secret_key) +
         "# The coordinator's public key; the client talks to no other coordinator.\n" +
         key_line("server", key.server_key);
}

std::string text_of_server_key(const KeyPair& pair) {
  return std::string("# Key of a Swarmsmith coordinator.\n") + kWarning + "format = 1\n" +
         key_line("role", kServerRole) + key_line("public", pair.public_key) +
         key_line("secret", pair.secret_key);
}

Expected<ClientKeyFile> parse_client_key(std::string_view text, const std::string& file) {
  Expected<Fields> fields = parse_fields(text, file);
  if (!fields) return Unexpected(fields.error());
  const auto role = role_of(fields->role);
  if (!role) {
    return bad_input(
        "this is the coordinator's key, which stays with it; clients use others, such as "
        "worker.key",
        file);
  }
  return ClientKeyFile{
      .name = fields->name, .role = *role, .pair = fields->pair, .server_key = fields->server_key};
}

Expected<KeyPair> parse_server_key(std::string_view text, const std::string& file) {
  Expected<Fields> fields = parse_fields(text, file);
  if (!fields) return Unexpected(fields.error());
  if (fields->role != kServerRole) {
    return bad_input("this is a client's key, not a coordinator's (server.key)", file);
  }
  return fields->pair;
}

Expected<ClientKeyFile> read_client_key(const std::filesystem::path& file) {
  Expected<std::string> text = read_private_file(file, "key file", Privacy::Secret);
  if (!text) return Unexpected(text.error());
  return parse_client_key(*text, file.string());
}

Expected<KeyPair> read_server_key(const std::filesystem::path& file) {
  Expected<std::string> text = read_private_file(file, "key file", Privacy::Secret);
  if (!text) return Unexpected(text.error());
  return parse_server_key(*text, file.string());
}

}  // namespace swarmsmith
