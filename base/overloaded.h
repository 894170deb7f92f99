#pragma once

namespace swarmsmith {

/// One callable object made of several lambdas, for std::visit over a variant. Without a default
/// case, code does not compile after a new alternative is added until each visitor handles it.
template <class... Callables>
struct Overloaded : Callables... {
  using Callables::operator()...;
};

/// GCC does not need this; clang 14 does.
template <class... Callables>
Overloaded(Callables...) -> Overloaded<Callables...>;

}  // namespace swarmsmith
