#include "coordinator/launchers/host_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "base/plain_text.h"
#include "base/suggestion.h"
#include "base/text/whole_file.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kMostSlots = 1024;
constexpr std::size_t kMostBytes = 1U << 20U;

struct Word {
  std::string_view text;
  std::size_t column;  ///< from 1
};

std::vector<Word> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<Word> words;
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back({line.substr(begin, end - begin), begin + 1});
    begin = end;
  }
  return words;
}

/// Parses one file, line by line.
class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  void read_line(std::string_view line) {
    ++line_;
    const std::vector<Word> words = words_of(line);
    if (words.empty()) return;
    SshHost host{.name = std::string(words.front().text)};
    // ssh would take such a name for one of its options.
    if (host.name.starts_with('-') || host.name.find('=') != std::string::npos) {
      complain(words.front(),
               "a line must begin with the name of a host, and `" + host.name + "` is not one");
    }
    for (std::size_t i = 1; i < words.size(); ++i)
      read_setting(words[i], host);
    const auto same = [&](const SshHost& other) { return other.name == host.name; };
    if (std::ranges::any_of(hosts_, same)) {
      complain(words.front(), "`" + host.name + "` is given twice; give it more slots instead");
    }
    hosts_.push_back(std::move(host));
  }

  HostsOrErrors finish() {
    if (hosts_.empty() && errors_.empty()) {
      errors_.push_back({ErrorKind::BadInput,
                         "the file has no host; write one per line, such as node1 slots=16",
                         file_});
    }
    if (!errors_.empty()) return tl::unexpected(std::move(errors_));
    return std::move(hosts_);
  }

 private:
  void complain(const Word& word, std::string message) {
    errors_.push_back({ErrorKind::BadInput, std::move(message),
                       file_ + ":" + std::to_string(line_) + ":" + std::to_string(word.column)});
  }

  void read_setting(const Word& word, SshHost& host) {
    static const std::array<std::string, 4> kKeys = {"slots", "program", "key", "coordinator"};
    const std::size_t sign = word.text.find('=');
    const std::string key(word.text.substr(0, sign));
    const auto place = std::ranges::find(kKeys, key) - kKeys.begin();
    if (sign == std::string_view::npos || place == 4) {
      complain(word, "`" + std::string(word.text) +
                         "` is not one of slots=N, program=PATH, key=PATH, " + "coordinator=PATH" +
                         did_you_mean(key, kKeys));
      return;
    }
    const std::string_view value = word.text.substr(sign + 1);
    if (place == 0) {
      const char* end = value.data() + value.size();
      const auto [stop, error] = std::from_chars(value.data(), end, host.slots);
      const bool number = error == std::errc() && stop == end;
      if (number && host.slots >= 1 && host.slots <= kMostSlots) return;
      complain(word, "`slots` must be a number from 1 to 1024, not `" + std::string(value) + "`");
      return;
    }
    if (!value.starts_with('/')) {
      complain(word, "`" + key + "` must be an absolute path on that host, not `" +
                         std::string(value) + "`");
      return;
    }
    (place == 1 ? host.program : place == 2 ? host.key : host.coordinator) = value;
  }

  std::string file_;
  std::size_t line_ = 0;
  std::vector<SshHost> hosts_;
  std::vector<Error> errors_;
};

}  // namespace

HostsOrErrors parse_hosts(std::string_view text, const std::filesystem::path& file) {
  Reader reader(file.string());
  for (const std::string_view line : split_lines(text))
    reader.read_line(line);
  return reader.finish();
}

HostsOrErrors read_hosts(const std::filesystem::path& file) {
  const auto text = read_file(file, "host", kMostBytes);
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  return parse_hosts(*text, file);
}

}  // namespace swarmsmith
