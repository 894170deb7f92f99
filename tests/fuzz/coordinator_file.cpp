#include "proto/access/coordinator_file.h"

#include "proto/access/key_file.h"
#include "proto/socket.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// The files that connecting begins with: each refuses with a reason, or prints what reads back as
/// the same.
void run(std::string_view input) {
  const auto file = parse_coordinator_file(input, "c.db.coordinator");
  if (file) {
    require(address_of(file->endpoint).has_value(), "an endpoint can be connected to");
    require(parse_coordinator_file(text_of(*file), "printed") == file,
            "what is printed reads back as the same");
  } else {
    require_reasons({file.error()});
  }
  const auto key = parse_client_key(input, "worker.key");
  if (key) {
    const auto again = parse_client_key(text_of(*key), "printed");
    require(again && again->pair.secret_key == key->pair.secret_key && again->name == key->name,
            "what is printed reads back as the same");
  }
}

}  // namespace swarmsmith::fuzz
