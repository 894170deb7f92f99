#include "coordinator/service/http_address.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cstring>

namespace swarmsmith {
namespace {

constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestToken = 512;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Closes a file descriptor at the end of its scope.
class Closer {
 public:
  explicit Closer(int fd) : fd_(fd) {}
  ~Closer() {
    if (fd_ >= 0) close(fd_);
  }
  Closer(const Closer&) = delete;
  Closer& operator=(const Closer&) = delete;

 private:
  int fd_;
};

}  // namespace

bool is_our_host(std::string_view header, const Address& address, const std::string& host_name) {
  const auto [name, port] = split_address(header);
  const std::string host = lower(name);
  if (host.empty() || (port && !std::ranges::all_of(*port, is_digit))) return false;
  if (is_loopback(host)) return true;
  if (is_loopback(lower(address.host))) return false;
  return is_host_number(host) || host == lower(address.host) || host == lower(host_name);
}

Expected<std::string> read_token(const std::filesystem::path& file) {
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const Closer closer(fd);
  if (fd < 0) {
    return unexpected(ErrorKind::NotFound,
                      std::string("the token cannot be read: ") + std::strerror(errno),
                      file.string());
  }
  struct stat facts = {};
  if (fstat(fd, &facts) != 0 || !S_ISREG(facts.st_mode)) {
    return bad_input("the token must be in an ordinary file", file.string());
  }
  if ((facts.st_mode & 077U) != 0) {
    return bad_input("others can read the token: chmod 600 " + file.string(), file.string());
  }
  std::string token(kLongestToken + 1, '\0');
  const ssize_t size = read(fd, token.data(), token.size());
  token.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  token.resize(std::min(token.size(), token.find_last_not_of(" \t\r\n") + 1));
  const bool plain = std::ranges::all_of(token, [](char c) { return c > ' ' && c < 0x7f; });
  if (token.size() < kShortestToken || token.size() > kLongestToken || !plain) {
    return bad_input(
        "a token is one line of 16 to 512 characters without spaces; make one with: head -c 32 "
        "/dev/urandom | base64",
        file.string());
  }
  return token;
}

bool has_token(std::string_view header, std::string_view token) {
  constexpr std::string_view kScheme = "Bearer ";
  if (!header.starts_with(kScheme)) return false;
  header.remove_prefix(kScheme.size());
  unsigned difference = header.size() == token.size() ? 0U : 1U;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char c = i < header.size() ? header[i] : '\0';
    difference |= static_cast<unsigned>(c ^ token[i]);
  }
  return difference == 0;
}

}  // namespace swarmsmith
