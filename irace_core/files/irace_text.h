#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// The content of a file, and the file's name in messages.
struct IraceText {
  std::string text;
  std::string file;
};

}  // namespace swarmsmith
