#pragma once

#include <sys/types.h>
#include <zmq.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "proto/curve.h"
#include "proto/internal/tcp_bytes.h"
#include "proto/internal/zmq_support.h"
#include "proto/socket.h"

namespace swarmsmith {

/// Stands at a server's door: answers libzmq's question whether a key may come in (ZAP,
/// rfc.zeromq.org/spec/27), counts who was kept out, and keeps connections within their limits, in
/// number and in bytes that wait to be taken, of each, of a host and of all. It has a thread of its
/// own, so that handshakes do not wait for a step of a race, nor a step for a crowd of strangers.
class Gate {
 public:
  /// Bytes of a connection that were taken: its frames, and about what comes with them.
  using Taken = std::shared_ptr<std::atomic<std::uint64_t>>;

  /// Who comes in: whose key is listed; who is of the same user of this host; else all.
  struct Asks {
    bool key = false;
    bool user = false;
  };

  /// Before the server's socket is bound; both must outlive the object.
  Gate(zmq::context_t& context, zmq::socket_t& server, Asks asks, const SocketOptions& options);
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void admit(std::vector<ListedClient> clients);
  /// Who has this key, unless the time of the key is over.
  std::optional<ListedClient> find(const std::string& public_key) const;
  void count_refusal(const std::string& reason, const std::string& from);
  Refusals refusals() const;
  /// Of an open connection, to be counted up by who takes its frames; else null.
  Taken meter_of(const Connection& connection);

 private:
  struct Open {
    TimePoint since;
    Connection connection;
    std::string network;
    bool young = true;  ///< its handshake may still go on
    bool cut = false;
  };

  void work();
  void answer_request();
  std::string objection_to(const std::string& public_key) const;
  void hear_event(TimePoint now);
  void let_in(int descriptor, TimePoint now);
  void forget(int descriptor);
  void weigh(TimePoint now);
  void weigh_all(std::size_t resident);
  void grow_old(TimePoint now);
  void count_silent();

  mutable std::mutex mutex_;
  std::unordered_map<std::string, ListedClient> clients_;  ///< by public key
  Refusals refusals_;
  std::unordered_map<ino_t, Taken> meters_;  ///< of open connections

  zmq::socket_t* server_;
  Wakeup stop_;
  zmq::socket_t requests_;  ///< the thread's; empty when all clients come in
  zmq::socket_t monitor_;   ///< the thread's

  // Connections; the thread's. Their descriptors name them.
  Asks asks_;
  SocketOptions options_;
  Duration young_for_;
  std::unordered_map<int, Open> open_;
  std::unordered_map<std::string, int> open_of_;  ///< how many, by network
  TimePoint weighed_;
  std::size_t resident_ = 0;  ///< bytes of this process when it was weighed
  std::size_t calm_ = 0;      ///< the same, when next to nothing waited
  std::deque<std::pair<TimePoint, int>>
      handshakes_;  ///< of young ones and of closed ones, oldest first
  std::int64_t young_ = 0;
  std::int64_t accepted_ = 0;
  std::int64_t succeeded_ = 0;

  std::thread thread_;
};

}  // namespace swarmsmith
