#include "base/process/interrupt.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

namespace swarmsmith {

Interrupt::Interrupt() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Interrupt::~Interrupt() {
  close(descriptor_);
}

void Interrupt::trigger() {
  triggered_ = true;
  eventfd_write(descriptor_,
                1);  // cannot fail: the counter is never read, and one trigger is enough
}

bool Interrupt::wait_ms(int milliseconds) const {
  pollfd watched{descriptor_, POLLIN, 0};
  poll(&watched, 1, milliseconds);
  return triggered();
}

}  // namespace swarmsmith
