#pragma once

#include <string>

namespace swarmsmith {

/// Digest of a few short fixed simulations. A program with another compiler, library or engine
/// whose scores could differ has another one: coordinator and workers compare theirs.
std::string self_test_digest();

}  // namespace swarmsmith
