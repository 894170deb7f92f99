#include "cli/dashboard/answer_cache.h"

#include <iterator>
#include <thread>
#include <utility>

namespace swarmsmith::cli {

void AnswerCache::wait_for_all() {
  std::unique_lock lock(mutex_);
  none_works_.wait(lock, [&] { return working_ == 0; });
}

AnswerCache::Answer AnswerCache::kept_for(const std::string& question, const std::string& stamp,
                                          Clock::time_point oldest, bool& is_late) {
  const auto found = kept_.find(question);
  if (found == kept_.end()) return nullptr;
  const Kept& kept = *found->second;
  const bool same = !stamp.empty() && kept.stamp == stamp;
  const bool holds = kept.answer->is_good && (kept.answer->is_final || same || kept.when >= oldest);
  is_late = Clock::now() < kept.until;
  if (!holds && !is_late) return nullptr;
  order_.splice(order_.begin(), order_, found->second);
  return kept.answer;
}

AnswerCache::Answer AnswerCache::get(const std::string& question, const std::string& stamp,
                                     Clock::time_point oldest,
                                     const std::function<KeptAnswer()>& make, bool& shared) {
  shared = true;
  std::promise<Answer> promise;
  std::uint64_t number = 0;
  {
    std::unique_lock lock(mutex_);
    bool is_late = false;
    if (const Answer kept = kept_for(question, stamp, oldest, is_late)) return kept;
    if (const auto found = under_way_.find(question);
        found != under_way_.end() && found->second.when >= oldest) {
      const std::shared_future<Answer> answer = found->second.answer;
      lock.unlock();
      return answer.get();
    }
    number = ++begun_;
    under_way_[question] = {number, Clock::now(), promise.get_future().share(), forgotten_};
  }
  shared = false;
  const auto answer = std::make_shared<const KeptAnswer>(make());
  {
    const std::scoped_lock lock(mutex_);
    finish(question, stamp, number, answer);
  }
  promise.set_value(answer);
  return answer;
}

AnswerCache::SoFar AnswerCache::get_within(const std::string& question, const std::string& stamp,
                                           Clock::time_point oldest,
                                           std::function<KeptAnswer()> make, const Turn& turn,
                                           std::chrono::milliseconds patience) {
  std::shared_future<Answer> coming;
  Clock::time_point begun;
  SoFar so_far{.shared = true};
  Turn its_turn = turn;
  {
    const std::scoped_lock lock(mutex_);
    bool is_late = false;
    if (Answer kept = kept_for(question, stamp, oldest, is_late)) {
      so_far.seconds = is_late ? kept->seconds : 0;
      so_far.answer = std::move(kept);
      return so_far;
    }
    const auto found = under_way_.find(question);
    if (found != under_way_.end() && found->second.turn &&
        (found->second.is_late || found->second.when >= oldest)) {
      coming = found->second.answer;
      begun = found->second.when;
      its_turn = found->second.turn;
    } else {
      auto promise = std::make_shared<std::promise<Answer>>();
      coming = promise->get_future().share();
      begun = Clock::now();
      const std::uint64_t number = ++begun_;
      under_way_[question] = {number, begun, coming, forgotten_, turn};
      so_far.shared = false;
      ++working_;
      std::thread([this, question, stamp, number, promise, make = std::move(make)] {
        const auto answer = std::make_shared<const KeptAnswer>(make());
        const std::scoped_lock at_its_end(mutex_);
        finish(question, stamp, number, answer);
        promise->set_value(answer);
        --working_;
        none_works_.notify_all();
      }).detach();
    }
  }
  const bool is_there = coming.wait_for(patience) == std::future_status::ready;
  const std::scoped_lock lock(mutex_);
  if (is_there || coming.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    so_far.answer = coming.get();
    so_far.seconds = so_far.shared ? 0 : so_far.answer->seconds;
    return so_far;
  }
  // The computation is still running, or a later one has replaced it.
  if (const auto own = under_way_.find(question); own != under_way_.end())
    own->second.is_late = true;
  so_far.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  so_far.goes_on = its_turn->load();
  return so_far;
}

void AnswerCache::finish(const std::string& question, const std::string& stamp,
                         std::uint64_t number, const Answer& answer) {
  const auto own = under_way_.find(question);
  if (own == under_way_.end() || own->second.number != number) {
    // A later computation has replaced this one.
    return;
  }
  const UnderWay way = own->second;
  under_way_.erase(own);
  if (way.is_late) {
    keep(question, stamp, way.when, answer, Clock::now() + kLate);
  } else if (answer->is_good && way.forgotten == forgotten_) {
    keep(question, stamp, way.when, answer);
  }
}

void AnswerCache::keep(const std::string& question, const std::string& stamp,
                       Clock::time_point when, const Answer& answer, Clock::time_point until) {
  if (const auto old = kept_.find(question); old != kept_.end()) {
    if (old->second->when > when) return;
    bytes_ -= weight(*old->second);
    order_.erase(old->second);
    kept_.erase(old);
  }
  order_.push_front({question, stamp, when, answer, until});
  kept_[question] = order_.begin();
  bytes_ += weight(order_.front());
  while (bytes_ > most_bytes_) {
    bytes_ -= weight(order_.back());
    kept_.erase(order_.back().question);
    order_.pop_back();
  }
}

std::size_t AnswerCache::weight(const Kept& kept) {
  constexpr std::size_t kOverhead = 500;
  return kOverhead + 2 * kept.question.size() + kept.stamp.size() + kept.answer->packed.size();
}

void AnswerCache::forget() {
  const std::scoped_lock lock(mutex_);
  ++forgotten_;
  for (auto at = order_.begin(); at != order_.end();) {
    if (at->answer->is_final) {
      ++at;
      continue;
    }
    bytes_ -= weight(*at);
    kept_.erase(at->question);
    at = order_.erase(at);
  }
}

std::optional<Turnstile::Pass> Turnstile::enter(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (inside_ >= at_a_time_ && !closed_) {
    if (waiting_ >= most_waiting_) return std::nullopt;
    ++waiting_;
    left_.wait_for(lock, patience, [&] { return inside_ < at_a_time_ || closed_; });
    --waiting_;
  }
  if (inside_ >= at_a_time_ || closed_) return std::nullopt;
  ++inside_;
  return std::optional<Pass>(std::in_place, *this);
}

void Turnstile::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  left_.notify_all();
}

int Turnstile::waiting() {
  const std::scoped_lock lock(mutex_);
  return waiting_;
}

Turnstile::Pass::~Pass() {
  if (turnstile_ == nullptr) return;
  {
    const std::scoped_lock lock(turnstile_->mutex_);
    --turnstile_->inside_;
  }
  turnstile_->left_.notify_one();
}

}  // namespace swarmsmith::cli
