#pragma once

namespace swarmsmith {

/// The permissions of a peer, which depend on its key. On a connection without keys, which is
/// possible only on loopback unless --insecure was given, all clients may do everything.
enum class Role {
  Anyone,    ///< no key: may do everything that the others may
  Worker,    ///< takes tasks, and nothing else
  Operator,  ///< pauses, resumes, cancels, gives more budget; reads
  Reader,    ///< asks for the status
};

constexpr bool may_work(Role role) {
  return role == Role::Worker || role == Role::Anyone;
}
constexpr bool may_command(Role role) {
  return role == Role::Operator || role == Role::Anyone;
}
constexpr bool may_read(Role role) {
  return role != Role::Worker;
}

}  // namespace swarmsmith
