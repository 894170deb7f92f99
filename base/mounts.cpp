#include "base/mounts.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace swarmsmith {
namespace {

bool is_octal(char letter) {
  return letter >= '0' && letter <= '7';
}

/// The kernel writes blanks, tabs, line ends and backslashes as \040 and so on.
std::string unescaped(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped = text[i] == '\\' && i + 3 < text.size() && is_octal(text[i + 1]) &&
                         is_octal(text[i + 2]) && is_octal(text[i + 3]);
    if (escaped) {
      plain += static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 +
                                 (text[i + 3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

}  // namespace

std::vector<Mount> mounts(const std::filesystem::path& root) {
  std::vector<Mount> mounts;
  std::istringstream file(small_system_file(root / "proc/self/mountinfo"));
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Mount mount;
    std::string parent, device, inside, point, word, source;
    words >> mount.id >> parent >> device >> inside >> point;
    // Options of the mount, and any number of optional fields.
    while (words >> word && word != "-") {
    }
    if (!(words >> mount.type >> source)) continue;
    words >> mount.options;
    mount.root = unescaped(inside);
    mount.point = unescaped(point);
    mount.source = unescaped(source);
    mounts.push_back(std::move(mount));
  }
  return mounts;
}

std::string small_system_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace swarmsmith
