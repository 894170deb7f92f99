#include "sim/engine/internal/float32.h"

namespace swarmsmith {

double as_float32(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace swarmsmith
