#include "proto/access/allow_list.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Lists of clients are refused with reasons and places, or print to a list that reads as the same.
void run(std::string_view input) {
  const auto list = parse_allow_list(input, "clients.toml");
  if (!list) return require_reasons(list.error());
  std::string text = "format = 1\n";
  for (const AllowedClient& client : *list) {
    require(is_key(client.public_key), "a listed key is one");
    text += text_of(client);
  }
  require(parse_allow_list(text, "clients.toml") == list, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
