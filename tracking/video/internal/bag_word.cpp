#include "tracking/video/internal/bag_word.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace swarmsmith {
namespace {

bool is_bag(const std::string& file) {
  if (file.ends_with(".bag")) return true;
  // Of a pipe nothing must be taken.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  constexpr std::string_view kMark = "#ROSBAG";
  std::array<char, kMark.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == kMark;
}

}  // namespace

std::optional<BagWord> bag_word(const std::string& word) {
  std::error_code ignored;
  if (is_bag(word)) return BagWord{word, {}};
  // Names of topics have no colon.
  const std::size_t colon = word.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(word, ignored)) return std::nullopt;
  const std::string file = word.substr(0, colon);
  if (!is_bag(file)) return std::nullopt;
  return BagWord{file, word.substr(colon + 1)};
}

}  // namespace swarmsmith
