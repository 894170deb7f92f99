#pragma once

#include <string>

namespace swarmsmith {

/// What came of reading a recording in a process of its own.
struct ReadApart {
  int status = 0;  ///< as `wait` has it
  long most_memory_mb = 0;
  std::string said;  ///< the error with its place; empty: it read
  long frames = 0;
  bool is_odd = false;
};

/// Reads all frames of it, with 20 s of processor at most.
ReadApart read_apart(const std::string& word);

/// The same by `swarmsmith-track detect`, which must lie beside the test; it gives no count of
/// frames.
ReadApart detected_apart(const std::string& word);
bool has_track_program();

}  // namespace swarmsmith
