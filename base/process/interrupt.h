#pragma once

#include <atomic>

namespace swarmsmith {

/// Ends the programs that run under it, from any thread: once triggered, always triggered.
class Interrupt {
 public:
  /// Throws std::system_error when there is no descriptor left.
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  void trigger();
  bool triggered() const { return triggered_.load(); }
  /// Becomes readable with the trigger, and stays so.
  int descriptor() const { return descriptor_; }
  /// Waits as long, or until it is triggered; whether it was.
  bool wait_ms(int milliseconds) const;

 private:
  int descriptor_ = -1;
  std::atomic<bool> triggered_{false};
};

}  // namespace swarmsmith
