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

/// Controls the access to a server. It answers libzmq's question whether to admit a key (ZAP,
/// rfc.zeromq.org/spec/27), counts refused peers, and keeps connections within their limits: their
/// number, and the bytes that wait to be received, for each connection, each host and in total. It
/// has its own thread, so that handshakes do not wait for a step of a race, nor a step for a crowd
/// of unknown peers.
class Gate {
 public:
  /// Bytes received from a connection: its frames, and their approximate overhead.
  using Taken = std::shared_ptr<std::atomic<std::uint64_t>>;

  /// What a newcomer must prove: that its key is listed, or that its process belongs to the same
  /// user of this host. Without either, all are admitted.
  struct Asks {
    bool key = false;
    bool user = false;
  };

  /// To be made before the server's socket is bound; both arguments must outlive the object.
  Gate(zmq::context_t& context, zmq::socket_t& server, Asks asks, const SocketOptions& options);
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void admit(std::vector<ListedClient> clients);
  /// The client with this key, unless the key has expired.
  std::optional<ListedClient> find(const std::string& public_key) const;
  void count_refusal(const std::string& reason, const std::string& from);
  Refusals refusals() const;
  /// The byte count of an open connection, to be increased by the code that receives its frames;
  /// null for a closed one.
  Taken meter_of(const Connection& connection);

 private:
  struct Open {
    TimePoint since;
    Connection connection;
    std::string network;
    bool young = true;  ///< its handshake may not have ended yet
    bool cut = false;
  };

  void work();
  void answer_request();
  std::string objection_to(const std::string& public_key) const;
  void hear_event(TimePoint now);
  void let_in(int descriptor, TimePoint now);
  void forget(int descriptor);
  void drop_lost_meters();
  void weigh(TimePoint now);
  void weigh_all(std::size_t resident);
  void grow_old(TimePoint now);
  void count_silent();

  mutable std::mutex mutex_;
  std::unordered_map<std::string, ListedClient> clients_;  ///< by public key
  Refusals refusals_;
  std::unordered_map<ino_t, Taken> meters_;  ///< of connections, by inode

  zmq::socket_t* server_;
  Wakeup stop_;
  zmq::socket_t requests_;  ///< used by the thread; empty when all clients are admitted
  zmq::socket_t monitor_;   ///< used by the thread

  // Connections, used by the thread only, identified by their descriptors.
  Asks asks_;
  SocketOptions options_;
  Duration young_for_;
  std::unordered_map<int, Open> open_;
  std::unordered_map<std::string, int> open_of_;  ///< number of connections by network
  TimePoint weighed_;
  std::size_t resident_ = 0;  ///< memory of this process at the last weighing, bytes
  std::size_t calm_ = 0;      ///< the same when almost nothing waited
  std::deque<std::pair<TimePoint, int>>
      handshakes_;  ///< of young and of closed connections, oldest first
  std::int64_t young_ = 0;
  std::int64_t accepted_ = 0;
  std::int64_t succeeded_ = 0;

  std::thread thread_;
};

}  // namespace swarmsmith
