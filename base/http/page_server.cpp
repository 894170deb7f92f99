#include "base/http/page_server.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace swarmsmith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kUnclear =
    "HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
constexpr std::string_view kBusy =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

thread_local int asked_by = -1;

/// Sets the socket of the request while it is answered.
class Asked {
 public:
  explicit Asked(int socket) { asked_by = socket; }
  ~Asked() { asked_by = -1; }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
};

/// Lowers the priority of this thread only.
void stand_back(int nice) {
  thread_local bool done = false;
  if (done || nice == 0) return;
  done = true;
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice);
}

/// A stream with a request's complete head; the output is kept.
class HeadStream : public httplib::Stream {
 public:
  HeadStream(int socket, std::string head) : socket_(socket), head_(std::move(head)) {}

  bool is_readable() const override { return read_ < head_.size(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* data, std::size_t size) override {
    const std::size_t got = head_.copy(data, size, read_);
    read_ += got;
    return static_cast<ssize_t>(got);
  }
  ssize_t write(const char* data, std::size_t size) override {
    written_.append(data, size);
    return static_cast<ssize_t>(size);
  }
  // No program needs these addresses: see PageServer::socket_of_request.
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

  const std::string& written() const { return written_; }

 private:
  int socket_;
  std::string head_;
  std::size_t read_ = 0;
  std::string written_;
};

/// A stream that sends the output until the deadline. With a time-out for each write, a peer that
/// reads one byte per second would hold a thread for hours.
class DeadlineStream final : public HeadStream {
 public:
  DeadlineStream(int socket, std::string head, std::optional<Clock::time_point> deadline)
      : HeadStream(socket, std::move(head)), deadline_(deadline) {}

  bool is_writable() const override {
    int left_ms = kLongestPause;
    if (deadline_) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - Clock::now());
      if (left.count() <= 0) return false;
      left_ms = static_cast<int>(left.count());
    }
    pollfd ready{.fd = socket(), .events = POLLOUT, .revents = 0};
    return ::poll(&ready, 1, left_ms) > 0;
  }
  ssize_t write(const char* data, std::size_t size) override {
    if (!is_writable()) return -1;
    return ::send(socket(), data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

 private:
  /// For a reader of an endless stream, who must take some data in this time.
  static constexpr int kLongestPause = 5000;

  std::optional<Clock::time_point> deadline_;
};

/// The text is short, so the system takes all of it, whether or not it is read.
void send_at_once(int socket, std::string_view text) {
  (void)!::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

/// Data after the head is read first: otherwise the system would discard the answer.
void close_connection(int socket) {
  constexpr int kMostReads = 16;
  std::array<char, 4096> rest{};
  ::shutdown(socket, SHUT_WR);
  for (int i = 0; i < kMostReads; ++i) {
    if (::recv(socket, rest.data(), rest.size(), MSG_DONTWAIT) <= 0) break;
  }
  ::close(socket);
}

/// Whether the line is the header with this name, given in lower case and with its colon.
bool has_name(std::string_view line, std::string_view name) {
  return line.size() >= name.size() &&
         std::equal(name.begin(), name.end(), line.begin(), [](char expected, char letter) {
           const bool upper = letter >= 'A' && letter <= 'Z';
           return expected == (upper ? letter + 32 : letter);
         });
}

bool is_read_by_pages(std::string_view line) {
  constexpr std::array<std::string_view, 6> kNames = {
      "host:", "authorization:", "origin:", "referer:", "sec-fetch-site:", "if-none-match:"};
  return std::ranges::any_of(kNames, [&](std::string_view name) { return has_name(line, name); });
}

/// Whether a request has only one meaning for all programs that read it: of two equal headers, a
/// proxy may use the second, while this program uses the first.
bool is_clear(std::string_view head) {
  constexpr std::array<std::string_view, 7> kOnce = {
      "host:",           "authorization:",  "origin:",           "referer:",
      "sec-fetch-site:", "content-length:", "transfer-encoding:"};
  std::array<int, kOnce.size()> seen{};
  head.remove_prefix(std::min(head.find('\n'), head.size() - 1) + 1);
  while (!head.empty()) {
    const std::size_t end = head.find('\n');
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(end == std::string_view::npos ? head.size() : end + 1);
    if (line.empty() || line == "\r") continue;
    // A continuation line, or a name that does not end at its colon.
    const std::size_t name = line.find_first_of(" \t:");
    if (name == 0 || name == std::string_view::npos || line[name] != ':') return false;
    for (std::size_t i = 0; i < kOnce.size(); ++i) {
      if (has_name(line, kOnce[i]) && ++seen[i] > 1) return false;
    }
  }
  return seen[kOnce.size() - 2] + seen.back() < 2;
}

/// The request line and the headers that pages read.
std::string bare(std::string_view head) {
  constexpr std::string_view kEncoding = "accept-encoding:";
  std::string kept;
  while (!head.empty()) {
    const std::size_t end = head.find('\n');
    const std::string_view line = head.substr(0, end == std::string_view::npos ? end : end + 1);
    head.remove_prefix(line.size());
    if (kept.empty() || is_read_by_pages(line)) {
      kept += line;
    } else if (has_name(line, kEncoding)) {
      kept += PageServer::kAccepts;
      kept += line.substr(kEncoding.size() - 1);
    }
  }
  return kept + "\r\n";
}

/// The path in a request line; empty when there is none.
std::string_view path_of(std::string_view head) {
  const std::size_t blank = head.find(' ');
  if (blank == std::string_view::npos) return {};
  head.remove_prefix(blank + 1);
  return head.substr(0, head.find_first_of(" ?\r\n"));
}

}  // namespace

int PageServer::socket_of_request() {
  return asked_by;
}

bool PageServer::is_asker_gone() {
  pollfd state{.fd = asked_by, .events = POLLRDHUP, .revents = 0};
  return asked_by >= 0 && ::poll(&state, 1, 0) > 0;
}

PageServer::PageServer(PageServerOptions options) : options_(std::move(options)) {
  set_payload_max_length(0);
}

PageServer::~PageServer() {
  stop_serving();
}

void PageServer::serve(ListeningSocket listening) {
  // The library closes its streams when it has no socket.
  svr_sock_ = listening.descriptor;
  pool_ = std::make_unique<httplib::ThreadPool>(options_.threads);
  door_ = std::make_unique<RequestDoor>(listening, options_.door,
                                        [this](int socket, const std::string& head) {
                                          if (is_clear(head)) return on_request(socket, bare(head));
                                          send_at_once(socket, kUnclear);
                                          close_connection(socket);
                                        });
}

void PageServer::stop_serving() {
  svr_sock_ = INVALID_SOCKET;
  door_.reset();
  if (pool_ != nullptr) pool_->shutdown();
  pool_.reset();
}

void PageServer::on_request(int socket, std::string head) {
  const std::string_view path = path_of(head);
  if (head.starts_with("GET ") && std::ranges::count(options_.at_once, path) > 0) {
    return answer_at_once(socket, std::move(head));
  }
  if (waiting_ >= options_.waiting) {
    send_at_once(socket, kBusy);
    return close_connection(socket);
  }
  ++waiting_;
  pool_->enqueue([this, socket, head = std::move(head)] {
    --waiting_;
    answer(socket, head);
  });
}

template <typename Stream>
void PageServer::process(Stream& stream) {
  bool closed = false;
  if constexpr (requires { this->process_request(stream, true, closed, nullptr); }) {
    this->process_request(stream, true, closed, nullptr);
  } else {
    // Since version 0.18 the function takes the addresses of both ends, which pages do not use.
    const std::string none;
    this->process_request(stream, none, 0, none, 0, true, closed, nullptr);
  }
}

void PageServer::answer_at_once(int socket, std::string head) {
  const Asked asked(socket);
  HeadStream stream(socket, std::move(head));
  process(stream);
  send_at_once(socket, stream.written());
  close_connection(socket);
}

void PageServer::answer(int socket, std::string head) {
  stand_back(options_.nice);
  const Asked asked(socket);
  auto time = options_.answer_time;
  if (options_.other_time) {
    if (const auto other = options_.other_time(path_of(head))) time = other;
  }
  const auto deadline = time ? std::optional(Clock::now() + *time) : std::nullopt;
  DeadlineStream stream(socket, std::move(head), deadline);
  process(stream);
  close_connection(socket);
}

}  // namespace swarmsmith
