#pragma once

#include <string>

#include "sim/control/controller.h"

namespace swarmsmith {

/// Digest of a few short fixed simulations with a machine, a tree and a network. It differs for
/// programs with another compiler, library or engine whose scores could differ; coordinator and
/// workers compare their digests.
std::string self_test_digest();

/// The part of the digest for one architecture, which helps to locate a difference.
std::string self_test_digest(Architecture architecture);

}  // namespace swarmsmith
