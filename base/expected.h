#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace swarmsmith {

/// The kind of an `Error`; programs turn it into an exit code.
enum class ErrorKind {
  BadInput,     ///< invalid input: a file, a text, an argument, a message
  NotFound,     ///< no such id, file or name
  Conflict,     ///< it exists, but belongs to another campaign or is held by another process
  Corrupt,      ///< a store or message is damaged
  Newer,        ///< written by a newer version than this program
  Unavailable,  ///< a peer or the environment does not answer
};

/// An error outside of the program's own logic, as a value. `message` is a sentence for users with
/// what was found and what was expected; `where` is the place (file:line:column, a field's path, a
/// token's position; may be empty).
struct Error {
  ErrorKind kind = ErrorKind::BadInput;
  std::string message;
  std::string where;

  /// Not defaulted, since the ROS code for robots is C++17.
  friend bool operator==(const Error& a, const Error& b) {
    return a.kind == b.kind && a.message == b.message && a.where == b.where;
  }
};

/// A value of `T`, or the reason why there is none. It has the interface of C++23's std::expected,
/// which can replace it later.
template <class T>
using Expected = tl::expected<T, Error>;

using Unexpected = tl::unexpected<Error>;

inline Unexpected unexpected(ErrorKind kind, std::string message, std::string where = {}) {
  return Unexpected(Error{kind, std::move(message), std::move(where)});
}

inline Unexpected bad_input(std::string message, std::string where = {}) {
  return unexpected(ErrorKind::BadInput, std::move(message), std::move(where));
}

/// "where: message", or only the message when the place is unknown.
inline std::string to_string(const Error& error) {
  return error.where.empty() ? error.message : error.where + ": " + error.message;
}

}  // namespace swarmsmith
