#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// A file's content and the name that messages call it by.
struct IraceText {
  std::string text;
  std::string file;
};

}  // namespace swarmsmith
