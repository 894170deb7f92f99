#include "tracking/video/internal/bag_word.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace swarmsmith {
namespace {

struct Form {
  BagWord::Kind kind;
  std::string_view ending;
  std::string_view mark;
};
constexpr std::array kForms = {Form{BagWord::Kind::Ros1, ".bag", "#ROSBAG"},
                               Form{BagWord::Kind::Mcap, ".mcap", "\x89MCAP0\r\n"},
                               Form{BagWord::Kind::Sqlite, ".db3", "SQLite format 3"}};

std::optional<BagWord::Kind> kind_of(const std::string& file) {
  // Only regular files are read here, because reading would consume data of a pipe.
  std::error_code ignored;
  const bool is_there = std::filesystem::is_regular_file(file, ignored);
  std::array<char, 16> begin{};
  if (is_there) std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  for (const Form& form : kForms) {
    if (std::string_view(begin.data(), form.mark.size()) == form.mark) return form.kind;
  }
  for (const Form& form : kForms) {
    if (file.ends_with(form.ending)) return form.kind;
  }
  return std::nullopt;
}

}  // namespace

std::optional<BagWord> bag_word(const std::string& word) {
  std::error_code ignored;
  if (const auto kind = kind_of(word)) return BagWord{word, {}, *kind};
  // Names of topics contain no colon.
  const std::size_t colon = word.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(word, ignored)) return std::nullopt;
  const std::string file = word.substr(0, colon);
  const auto kind = kind_of(file);
  if (!kind) return std::nullopt;
  return BagWord{file, word.substr(colon + 1), *kind};
}

}  // namespace swarmsmith
