#include "proto/access/allow_list.h"

#include <cstdio>
#include <map>
#include <set>

#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "proto/access/role_text.h"

namespace swarmsmith {
namespace {

AllowedClient read_client(TableReader& table) {
  AllowedClient client;
  for (const char* needed : {"name", "role", "key"}) {
    if (!table.has(needed)) {
      table.complain(needed, "[[client]] needs a `" + std::string(needed) +
                                 "`; `swarmsmith keygen --client NAME` writes complete entries");
    }
  }
  if (const auto name = table.text("name")) {
    client.name = *name;
    if (!is_client_name(*name)) {
      table.complain(
          "name",
          "a client's name must consist of at most 64 letters, digits, \".\", \"_\" and \"-\"");
    }
  }
  if (const auto role = table.choice("role", kRoleNames)) client.role = *role_of(*role);
  if (const auto key = table.text("key")) {
    client.public_key = *key;
    if (!is_key(*key)) {
      table.complain("key",
                     "`key` must be a public key of 40 characters: the value of `public` in "
                     "the client's key file");
    }
  }
  client.expires = table.date("expires");
  table.finish();
  return client;
}

}  // namespace

AllowListOrErrors parse_allow_list(std::string_view text, const std::string& file) {
  const auto document = parse_document(text, file);
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file);
  TableReader root(*document, "", complaints);
  read_format(root);
  AllowList list;
  std::set<std::string> names;
  std::map<std::string, std::string> keys;  // the name for each key
  for (TableReader& table : root.tables("client")) {
    AllowedClient client = read_client(table);
    if (!names.insert(client.name).second && !client.name.empty()) {
      table.complain("name", "two clients have the name \"" + client.name + "\"");
    }
    const auto [other, fresh] = keys.emplace(client.public_key, client.name);
    if (!fresh && !client.public_key.empty()) {
      table.complain("key", "\"" + other->second + "\" has the same key");
    }
    list.push_back(std::move(client));
  }
  root.finish();
  if (!complaints.empty()) return tl::unexpected(complaints.take());
  return list;
}

std::string text_of(std::chrono::year_month_day date) {
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

std::optional<std::chrono::year_month_day> date_of(std::string_view text) {
  constexpr std::size_t kCharacters = 10;
  constexpr std::string_view kForm = "0000-00-00";
  if (text.size() != kCharacters) return std::nullopt;
  for (std::size_t i = 0; i < kCharacters; ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kForm[i] == '0' ? !digit : text[i] != '-') return std::nullopt;
  }
  const std::string digits(text);
  const std::chrono::year_month_day date(
      std::chrono::year(std::stoi(digits.substr(0, 4))),
      std::chrono::month(static_cast<unsigned>(std::stoi(digits.substr(5, 2)))),
      std::chrono::day(static_cast<unsigned>(std::stoi(digits.substr(8, 2)))));
  if (!date.ok()) return std::nullopt;
  return date;
}

std::string text_of(const AllowedClient& client) {
  std::string text = "[[client]]\nname = " + quoted_text(client.name) +
                     "\nrole = " + quoted_text(name_of(client.role)) +
                     "\nkey = " + quoted_text(client.public_key) + "\n";
  if (client.expires) text += "expires = " + text_of(*client.expires) + "\n";
  return text;
}

std::vector<ListedClient> clients_at(const AllowList& list, std::chrono::sys_seconds now) {
  std::vector<ListedClient> clients;
  for (const AllowedClient& client : list) {
    // `expires` is the last valid day, in UTC (docs/security.md, "The list: clients.toml").
    const bool expired =
        client.expires && now >= std::chrono::sys_days(*client.expires) + std::chrono::days(1);
    clients.push_back({.name = client.name,
                       .role = client.role,
                       .public_key = client.public_key,
                       .expired = expired});
  }
  return clients;
}

}  // namespace swarmsmith
