#pragma once

#include <string>

#include "sim/control/controller.h"

namespace swarmsmith {

/// Digest of a few short fixed simulations, of a machine, a tree and a network. A program with
/// another compiler, library or engine whose scores could differ has another one: coordinator and
/// workers compare theirs.
std::string self_test_digest();

/// The part of it with one machine, tree or network: what differs says more.
std::string self_test_digest(Architecture architecture);

}  // namespace swarmsmith
