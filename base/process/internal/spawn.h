#pragma once

#include <sys/types.h>
#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A file descriptor that the destructor closes; -1 for none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor() { reset(); }

  int get() const { return number_; }
  int release();
  void reset();

 private:
  int number_;
};

/// A program that was started in its own process group, and that has not been reaped.
struct Child {
  pid_t pid = 0;
  Descriptor output;  ///< non-blocking; reads its standard output
  Descriptor errors;
  Descriptor ended;  ///< readable when it has ended; none on kernels before 5.3
};

/// Starts `program` with these arguments (`words[0]` is the name that it sees) in a folder. Its
/// group is guarded (base/process/guard.h) until the caller unguards it.
Expected<Child> spawn(const std::string& program, const std::vector<std::string>& words,
                      const std::string& folder);

}  // namespace swarmsmith
