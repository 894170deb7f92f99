#include "robot/app/input_end.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace swarmsmith {

bool input_has_ended() {
  while (true) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (::poll(&input, 1, 0) <= 0) return false;
    if ((input.revents & POLLIN) == 0) return true;  // closed, or no descriptor at all
    std::array<char, 256> ignored{};
    const ssize_t read = ::read(STDIN_FILENO, ignored.data(), ignored.size());
    if (read == 0 || (read < 0 && errno != EINTR && errno != EAGAIN)) return true;
    if (read < 0) return false;
  }
}

}  // namespace swarmsmith
