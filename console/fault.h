#pragma once

#include <exception>
#include <string>

namespace swarmsmith {

/// A sentence about an exception that no command has turned into an error of its own: memory that
/// was refused, with how much there was; a fault of this program (a length or an index that cannot
/// be), which says so and asks to report it; else what the environment said.
std::string sentence_of_fault(const std::exception& fault);

}  // namespace swarmsmith
