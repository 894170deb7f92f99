#pragma once

#include <atomic>

namespace swarmsmith {

/// A flag that ends running programs, from any thread. Once triggered, it stays triggered.
class Interrupt {
 public:
  /// Throws std::system_error when there is no descriptor left.
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  void trigger();
  bool triggered() const { return triggered_.load(); }
  /// Becomes readable when triggered, and stays readable.
  int descriptor() const { return descriptor_; }
  /// Waits for this time, or until it is triggered; returns whether it was.
  bool wait_ms(int milliseconds) const;

 private:
  int descriptor_ = -1;
  std::atomic<bool> triggered_{false};
};

}  // namespace swarmsmith
