#pragma once

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/http/request_door.h"

namespace swarmsmith {

struct PageServerOptions {
  DoorLimits door{};
  std::size_t threads = 8;
  /// Most requests that wait for a thread; further ones get 503.
  std::size_t waiting = 64;
  /// Time from the request to the last byte of the answer; none: no limit.
  std::optional<std::chrono::milliseconds> answer_time = std::chrono::milliseconds(3000);
  /// The same of some paths, where it differs; empty: nowhere.
  std::function<std::optional<std::chrono::milliseconds>(std::string_view path)> other_time{};
  /// How far the threads that answer stand back behind others (nice).
  int nice = 0;
  /// Paths whose answers are short and cost nothing: the door answers them itself, without waiting.
  std::vector<std::string> at_once{};
};

/// The library's routing behind a RequestDoor: one request per connection, without a body. Pages
/// see the headers Host, Authorization, Origin, Referer, Sec-Fetch-Site and If-None-Match, and
/// Accept-Encoding under the name of `kAccepts`; no other header has an effect: no ranges, which
/// multiply an answer, no compression by the library. A request with two meanings (two Host
/// headers, a header that goes on in the next line) gets 400.
class PageServer : public httplib::Server {
 public:
  explicit PageServer(PageServerOptions options);
  ~PageServer() override;

  /// Serves until the end of the object, or `stop_serving`. Owns the socket. Handlers are set
  /// before.
  void serve(ListeningSocket listening);
  /// Waits for the answers in progress; handlers are no longer called.
  void stop_serving();

  /// For handlers: the socket that the request of this thread came by; -1 outside of them.
  static int socket_of_request();
  /// Whether the client has disconnected since.
  static bool is_asker_gone();

  /// The header Accept-Encoding, which the library would act upon.
  static constexpr const char* kAccepts = "Accepts";

 private:
  void on_request(int socket, std::string head);
  /// The one place that calls the library's protected function, whose parameters change with its
  /// version.
  template <typename Stream>
  void process(Stream& stream);
  void answer_at_once(int socket, std::string head);
  void answer(int socket, std::string head);

  PageServerOptions options_;
  std::unique_ptr<httplib::ThreadPool> pool_;
  std::atomic<std::size_t> waiting_ = 0;
  std::unique_ptr<RequestDoor> door_;
};

}  // namespace swarmsmith
