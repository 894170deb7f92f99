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
  /// Forgets notifications so far; by the thread that waits.
  void clear();
  int file_descriptor() const { return fd_; }

 private:
  int fd_;
};

}  // namespace swarmsmith
