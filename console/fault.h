#pragma once

#include <exception>
#include <string>

namespace swarmsmith {

/// A sentence about an exception that no command has handled. If memory was refused: how much there
/// was. If it is an error in this program (an impossible length or index): a request to report it.
/// Otherwise: the message of the exception.
std::string sentence_of_fault(const std::exception& fault);

}  // namespace swarmsmith
