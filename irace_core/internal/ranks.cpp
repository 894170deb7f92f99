#include "irace_core/internal/ranks.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"

namespace swarmsmith::irace {
namespace {

/// Calls `group(first, last, rank)` for every run of equal costs in a sorted row.
template <class Function>
void for_each_group(std::span<const Entry> sorted, Function group) {
  std::size_t first = 0;
  while (first < sorted.size()) {
    std::size_t last = first + 1;
    while (last < sorted.size() && sorted[last].cost == sorted[first].cost)
      ++last;
    group(first, last, 0.5 * static_cast<double>(first + 1 + last));
    first = last;
  }
}

double tie_term(std::size_t size) {
  const auto u = static_cast<double>(size);
  return u * u * u - u;
}

void sort_row(std::vector<Entry>& row) {
  std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.column < b.column;
  });
}

}  // namespace

RankTable::RankTable(std::size_t columns)
    : columns_(static_cast<std::int64_t>(columns)), sums_(columns, 0) {}

void RankTable::add_row(std::vector<Entry> row) {
  SWARMSMITH_ASSERT(static_cast<std::int64_t>(row.size()) == columns_, "a row is complete");
  sort_row(row);
  add_ranks(row);
  rows_.push_back(std::move(row));
}

void RankTable::keep(const std::vector<bool>& keeps) {
  SWARMSMITH_ASSERT(keeps.size() == sums_.size(), "there is a mark for each column");
  std::fill(sums_.begin(), sums_.end(), 0.0);
  ties_ = 0;
  squares_ = 0;
  columns_ = std::count(keeps.begin(), keeps.end(), true);
  for (std::vector<Entry>& row : rows_) {
    std::erase_if(row, [&](const Entry& entry) { return !keeps[entry.column]; });
    add_ranks(row);
  }
}

void RankTable::add_ranks(std::span<const Entry> sorted) {
  for_each_group(sorted, [&](std::size_t first, std::size_t last, double rank) {
    for (std::size_t i = first; i < last; ++i)
      sums_[sorted[i].column] += rank;
    squares_ += static_cast<double>(last - first) * rank * rank;
    ties_ += tie_term(last - first);
  });
}

}  // namespace swarmsmith::irace
