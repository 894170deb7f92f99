#pragma once

namespace swarmsmith {

/// Whether the other end of standard input is closed; does not wait, and discards input.
bool input_has_ended();

}  // namespace swarmsmith
