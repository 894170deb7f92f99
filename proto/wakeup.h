#pragma once

namespace swarmsmith {

/// Wakes a thread that waits on its sockets. `notify` may be called from any thread.
class Wakeup {
 public:
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  void notify();
  /// Forgets all notifications so far; to be called by the waiting thread.
  void clear();
  int file_descriptor() const { return fd_; }

 private:
  int fd_;
};

}  // namespace swarmsmith
