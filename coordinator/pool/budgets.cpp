#include "coordinator/pool/budgets.h"

#include <algorithm>

#include "base/assert.h"
#include "coordinator/pool/event_text.h"

namespace swarmsmith {
namespace {

/// Rough overhead of a row and of its line in the log: the budgets are limits of size, not
/// accounts.
constexpr std::size_t kRowBytes = 100;
constexpr std::size_t kLineBytes = 100;

}  // namespace

Budgets::Budgets(const BudgetOptions& options)
    : options_(options),
      rows_of_stranger_(options.rows_of_stranger),
      rows_of_known_(options.rows_of_known),
      rows_of_strangers_(options.rows_of_strangers),
      hellos_of_peer_(options.hellos_of_peer),
      hellos_of_principal_(options.hellos_of_principal),
      hellos_of_strangers_(options.hellos_of_strangers),
      answers_of_peer_(options.answers_of_peer),
      answer_bytes_(options.answer_bytes),
      commands_(options.commands) {}

bool Budgets::may_write(const Source& source, std::size_t bytes, TimePoint now) {
  // Principals with results have budgets of their own, which strangers cannot use up. A stranger
  // needs room in its own budget and in that of all strangers, since it may come under many
  // addresses.
  const auto amount = static_cast<double>(bytes);
  if (!source.is_stranger) return rows_of_known_.of(source.principal, now).take(amount, now);
  // Asked before it is taken, so that a full common budget does not use up the stranger's own.
  return rows_of_strangers_.has(amount, now) &&
         rows_of_stranger_.of(source.principal, now).take(amount, now) &&
         rows_of_strangers_.take(amount, now);
}

bool Budgets::may_say_hello(PeerId peer, const Source& source, TimePoint now) {
  // docs/security.md, "Budgets".
  const bool may = hellos_of_peer_.of(std::to_string(peer), now).take(1, now) &&
                   hellos_of_principal_.of(source.principal, now).take(1, now) &&
                   (!source.is_stranger || hellos_of_strangers_.take(1, now));
  if (!may) leave_out("hello");
  return may;
}

bool Budgets::may_be_sent(PeerId peer, std::size_t bytes, TimePoint now) {
  // A single answer may be larger than the burst; it then needs the full budget, and empties it.
  const double amount = std::min(static_cast<double>(bytes), options_.answer_bytes.burst);
  const bool may = answer_bytes_.has(amount, now) &&
                   answers_of_peer_.of(std::to_string(peer), now).take(1, now) &&
                   answer_bytes_.take(amount, now);
  if (!may) leave_out("answer");
  return may;
}

void Budgets::leave_out(std::string_view kind) {
  const auto at = left_out_.find(kind);
  ++(at != left_out_.end() ? at->second : left_out_[std::string(kind)]);
}

std::vector<EventRow> Budgets::take_news(TimePoint now, bool now_or_never) {
  std::vector<EventRow> news;
  // Reports are rows, too: one per kind and interval, whatever is left out.
  if ((now < tell_again_ && !now_or_never) || left_out_ == told_) return news;
  tell_again_ = now + options_.tell_every;
  for (const auto& [kind, count] : left_out_) {
    std::uint64_t& told = told_[kind];
    SWARMSMITH_ASSERT(told <= count, "an event that was left out is reported once");
    if (count == told) continue;
    news.push_back(
        pool_event("warning", "over budget",
                   {{"what", kind}, {"times", static_cast<std::int64_t>(count - told)}}));
    told = count;
  }
  return news;
}

std::size_t bytes_of(const WorkerRow& row) {
  return kRowBytes + kLineBytes + row.identity.size() + 2 * row.host.size() + row.build.size() +
         2 * row.job.size() + row.cpu.size() + 2 * row.client.size() + row.principal.size();
}

std::size_t bytes_of(const EventRow& row) {
  return kRowBytes + kLineBytes + 2 * (row.kind.size() + row.text.size());
}

std::size_t bytes_of(const FailureRow& row) {
  return kRowBytes + row.reason.size() + row.command.size() + row.output.size() + row.errors.size();
}

}  // namespace swarmsmith
