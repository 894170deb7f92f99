#include "robot/app/input_end.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace swarmsmith {

bool input_has_ended() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (::poll(&input, 1, 0) <= 0) return false;
  if ((input.revents & POLLIN) == 0) return true;  // closed, or no descriptor at all
  // One read per call: a program that writes all the time would keep a loop here for ever. It takes
  // all that a pipe holds.
  static std::array<char, 65'536> ignored;
  const ssize_t read = ::read(STDIN_FILENO, ignored.data(), ignored.size());
  return read == 0 || (read < 0 && errno != EINTR && errno != EAGAIN);
}

}  // namespace swarmsmith
