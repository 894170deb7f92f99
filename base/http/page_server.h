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
  /// Maximum number of requests that wait for a thread; further ones get 503.
  std::size_t waiting = 64;
  /// Time from the request to the last byte of the answer; empty: no limit.
  std::optional<std::chrono::milliseconds> answer_time = std::chrono::milliseconds(3000);
  /// The same for paths with another limit; empty: there are none.
  std::function<std::optional<std::chrono::milliseconds>(std::string_view path)> other_time{};
  /// The nice value of the threads that answer.
  int nice = 0;
  /// Paths with short answers that cost almost nothing: the door answers them itself, without
  /// waiting.
  std::vector<std::string> at_once{};
};

/// An HTTP server that uses the library's routing behind a RequestDoor: one request per connection,
/// without a body. Pages can read the headers Host, Authorization, Origin, Referer, Sec-Fetch-Site
/// and If-None-Match, and Accept-Encoding under the name `kAccepts`. Other headers have no effect:
/// there are no ranges, which multiply an answer, and no compression by the library. An ambiguous
/// request (two Host headers, a header that continues on the next line) gets 400.
class PageServer : public httplib::Server {
 public:
  explicit PageServer(PageServerOptions options);
  ~PageServer() override;

  /// Serves until this object is destroyed, or `stop_serving` is called. Owns the socket. Handlers
  /// must be set before.
  void serve(ListeningSocket listening);
  /// Waits for the answers in progress; no handlers are called after that.
  void stop_serving();

  /// For handlers: the socket of the request that this thread is answering; -1 outside of handlers.
  static int socket_of_request();
  /// Whether the client has disconnected meanwhile.
  static bool is_asker_gone();

  /// The name for the header Accept-Encoding, on which the library would act.
  static constexpr const char* kAccepts = "Accepts";

 private:
  void on_request(int socket, std::string head);
  /// The only place that calls the library's protected function, whose parameters change with its
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
