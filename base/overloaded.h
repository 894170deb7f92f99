#pragma once

namespace swarmsmith {

/// One callable out of several lambdas, for std::visit over a variant. Without a default case a new
/// alternative does not compile until every reader has thought of it.
template <class... Callables>
struct Overloaded : Callables... {
  using Callables::operator()...;
};

/// GCC does without; clang 14 does not.
template <class... Callables>
Overloaded(Callables...) -> Overloaded<Callables...>;

}  // namespace swarmsmith
