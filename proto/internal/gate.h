#pragma once

#include <zmq.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "proto/curve.h"
#include "proto/internal/zmq_support.h"
#include "proto/socket.h"

namespace swarmsmith {

/// Stands at a server's door: answers libzmq's question whether a key may come in (ZAP,
/// rfc.zeromq.org/spec/27), counts who was kept out, and keeps the number of connections within its
/// limit. It has a thread of its own, so that handshakes do not wait for a step of a race, nor a
/// step for a crowd of strangers.
class Gate {
 public:
  /// Before the server's socket is bound; both must outlive the object. With `admit_by_key` the
  /// keys decide, else everybody comes in.
  Gate(zmq::context_t& context, zmq::socket_t& server, bool admit_by_key,
       const SocketOptions& options);
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void admit(std::vector<ListedClient> clients);
  /// Who has this key, unless the time of the key is over.
  std::optional<ListedClient> find(const std::string& public_key) const;
  void count_refusal(const std::string& reason, const std::string& from);
  Refusals refusals() const;

 private:
  struct Connection {
    TimePoint since;
    bool young = true;  ///< its handshake may still go on
  };

  void work();
  void answer_request();
  std::string objection_to(const std::string& public_key) const;
  void hear_event(TimePoint now);
  void grow_old(TimePoint now);
  void count_silent();

  mutable std::mutex mutex_;
  std::unordered_map<std::string, ListedClient> clients_;  ///< by public key
  Refusals refusals_;

  zmq::socket_t* server_;
  Wakeup stop_;
  zmq::socket_t requests_;  ///< the thread's; empty when everybody comes in
  zmq::socket_t monitor_;   ///< the thread's

  // Connections; the thread's. Their descriptors name them.
  std::size_t max_connections_;
  Duration young_for_;
  std::unordered_map<int, Connection> open_;
  std::deque<std::pair<TimePoint, int>>
      handshakes_;  ///< of young ones and of closed ones, oldest first
  std::int64_t young_ = 0;
  std::int64_t accepted_ = 0;
  std::int64_t succeeded_ = 0;

  std::thread thread_;
};

}  // namespace swarmsmith
