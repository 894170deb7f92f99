#pragma once

#include <gtest/gtest.h>

#include <ranges>
#include <utility>

namespace swarmsmith {

/// A list that a test goes through, where an empty one would let it pass unseen. A temporary one is
/// moved, so that it lives as long as the loop.
template <class List>
List not_empty(List&& list) {
  EXPECT_FALSE(std::ranges::empty(list)) << "there is nothing to look at";
  return std::forward<List>(list);
}

}  // namespace swarmsmith
