#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/clock.h"
#include "base/expected.h"
#include "coordinator/service/service.h"
#include "proto/socket.h"

namespace swarmsmith {

/// Opens the listening socket described by the options, and sets their `bind` and
/// `insecure_plaintext` to the values actually used. Errors: as Service::open.
Expected<std::unique_ptr<ServerSocket>> open_front_door(ServiceOptions& options);

/// Logs which connections were refused, at a limited rate.
class RefusalLog {
 public:
  void say(const Refusals& refusals, TimePoint now);

 private:
  struct Said {
    std::uint64_t count = 0;
    TimePoint when;
  };
  std::map<std::string, Said> said_;
};

}  // namespace swarmsmith
