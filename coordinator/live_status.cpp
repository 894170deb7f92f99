#include "coordinator/live_status.h"

#include <nlohmann/json.hpp>

namespace swarmsmith {

std::string to_json(const LiveStatus& status) {
  const nlohmann::ordered_json json{{"workers", status.workers},
                                    {"slots", status.slots},
                                    {"ready", status.ready},
                                    {"leased", status.leased},
                                    {"done", status.done},
                                    {"rejected", status.rejected},
                                    {"failed", status.failed},
                                    {"requeued", status.requeued},
                                    {"duplicates", status.duplicates},
                                    {"conflicts", status.conflicts},
                                    {"malformed", status.malformed},
                                    {"uncommitted", status.uncommitted},
                                    {"evaluations_per_s", status.evaluations_per_s},
                                    {"trouble", status.trouble},
                                    {"insecure_plaintext", status.insecure_plaintext},
                                    {"refused", status.refused}};
  return json.dump();
}

}  // namespace swarmsmith
