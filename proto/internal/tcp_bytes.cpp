#include "proto/internal/tcp_bytes.h"

// The C library's netinet/tcp.h does not have the counters.
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <cstddef>

namespace swarmsmith {
namespace {

bool is_still(const Connection& connection) {
  struct stat status = {};
  return connection.descriptor >= 0 && fstat(connection.descriptor, &status) == 0 &&
         S_ISSOCK(status.st_mode) && status.st_ino == connection.inode;
}

}  // namespace

Connection connection_at(int descriptor) {
  struct stat status = {};
  if (descriptor < 0 || fstat(descriptor, &status) != 0 || !S_ISSOCK(status.st_mode)) return {};
  return {descriptor, status.st_ino};
}

void cut(const Connection& connection) {
  if (is_still(connection)) shutdown(connection.descriptor, SHUT_RDWR);
}

std::optional<TcpBytes> tcp_bytes_of(const Connection& connection) {
  if (!is_still(connection)) return std::nullopt;
  struct tcp_info info = {};
  socklen_t size = sizeof info;
  if (getsockopt(connection.descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0 ||
      size < offsetof(tcp_info, tcpi_bytes_received) + sizeof info.tcpi_bytes_received) {
    return std::nullopt;
  }
  return TcpBytes{info.tcpi_bytes_received, info.tcpi_bytes_acked};
}

}  // namespace swarmsmith
