#include "cli/dashboard/answer_cache.h"

#include <iterator>
#include <utility>

namespace swarmsmith::cli {

AnswerCache::Answer AnswerCache::get(const std::string& question, const std::string& stamp,
                                     Clock::time_point oldest,
                                     const std::function<KeptAnswer()>& make, bool& shared) {
  shared = true;
  std::promise<Answer> promise;
  std::uint64_t forgotten = 0;
  std::uint64_t number = 0;
  const auto when = Clock::now();
  {
    std::unique_lock lock(mutex_);
    if (const auto found = kept_.find(question); found != kept_.end()) {
      const Kept& kept = *found->second;
      const bool same = !stamp.empty() && kept.stamp == stamp;
      if (kept.answer->is_final || same || kept.when >= oldest) {
        order_.splice(order_.begin(), order_, found->second);
        return kept.answer;
      }
    }
    if (const auto found = under_way_.find(question);
        found != under_way_.end() && found->second.when >= oldest) {
      const std::shared_future<Answer> answer = found->second.answer;
      lock.unlock();
      return answer.get();
    }
    number = ++begun_;
    under_way_[question] = {number, when, promise.get_future().share()};
    forgotten = forgotten_;
  }
  shared = false;
  const auto answer = std::make_shared<const KeptAnswer>(make());
  {
    const std::scoped_lock lock(mutex_);
    const auto own = under_way_.find(question);
    if (own != under_way_.end() && own->second.number == number) under_way_.erase(own);
    if (answer->is_good && forgotten == forgotten_) keep(question, stamp, when, answer);
  }
  promise.set_value(answer);
  return answer;
}

void AnswerCache::keep(const std::string& question, const std::string& stamp,
                       Clock::time_point when, const Answer& answer) {
  if (const auto old = kept_.find(question); old != kept_.end()) {
    if (old->second->when > when) return;
    bytes_ -= weight(*old->second);
    order_.erase(old->second);
    kept_.erase(old);
  }
  order_.push_front({question, stamp, when, answer});
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

std::optional<Turnstile::Pass> Turnstile::enter() {
  std::unique_lock lock(mutex_);
  if (inside_ >= at_a_time_) {
    if (waiting_ >= most_waiting_) return std::nullopt;
    ++waiting_;
    left_.wait(lock, [&] { return inside_ < at_a_time_; });
    --waiting_;
  }
  ++inside_;
  return std::optional<Pass>(std::in_place, *this);
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
