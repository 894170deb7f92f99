#pragma once

#include <memory>
#include <vector>

#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

/// How a search by generations uses its budget.
struct GenerationPlan {
  std::int64_t generations = 0;
  /// Members of each generation; random search's last one may be smaller.
  std::int64_t population = 0;
  std::int64_t configurations = 0;  ///< of all generations together
  std::int64_t runs = 0;            ///< of each member, on pairs that its generation shares
  bool fresh_pairs = true;          ///< whether each generation has new pairs
  std::int64_t finalists = 0;       ///< members that the final stage runs again
  std::int64_t final_runs = 0;      ///< of each finalist, on new pairs

  /// If all generations share their pairs, they are only parts of one large generation, and the
  /// last one may be smaller.
  bool may_be_cut() const { return !fresh_pairs; }
};

/// The members of a generation: known ones, by their ids, and new ones.
struct Brood {
  std::vector<std::int64_t> known;
  std::vector<Newcomer> newcomers;
};

/// The part in which searches by generations differ.
class Breeder {
 public:
  virtual ~Breeder() = default;
  /// Makes generation `generation`, from 1, with `size` members. `last` is the generation before,
  /// best first; it is empty for the first generation. The first newcomer gets the id `next_id`.
  virtual Expected<Brood> breed(std::int64_t generation, std::int64_t size, std::int64_t next_id,
                                std::span<const Scored> last) = 0;
  /// Chooses the members of the final stage; `last` as above.
  virtual Expected<Brood> finalists(std::int64_t count, std::int64_t next_id,
                                    std::span<const Scored> last) = 0;
  /// The elites after a generation, best first; `generation` is in the same order.
  virtual std::vector<Scored> elites(std::span<const Scored> generation) = 0;
  virtual void add_to(Digest& digest) const = 0;
};

/// Generations of one size on common pairs, then a final stage, in which the best mean wins: the
/// mean of a generation's best member is too optimistic, and more so the larger the generation is.
class Generations final : public Strategy {
 public:
  Generations(GenerationPlan plan, std::unique_ptr<Breeder> breeder)
      : plan_(plan), breeder_(std::move(breeder)) {}

  Expected<std::optional<Round>> next(std::int64_t next_id) override;
  Verdict take(std::span<const double> costs) override;
  std::int64_t planned_iterations() const override {
    return iterations_before_ + plan_.generations + 1;
  }
  Expected<void> extend(std::int64_t experiments) override;
  Expected<std::int64_t> least_extension() const override;
  void add_to(Digest& digest) const override;

 private:
  bool is_final() const { return generation_ > plan_.generations; }

  GenerationPlan plan_;
  std::unique_ptr<Breeder> breeder_;
  /// Number of the generation in the plan; the final stage has the number after the last
  /// generation.
  std::int64_t generation_ = 0;
  std::int64_t iterations_before_ = 0;  ///< iterations of finished plans
  std::int64_t generation_number_ = 0;  ///< over all plans, without final stages
  std::int64_t bred_ = 0;               ///< configurations that the plan has made so far
  std::int64_t next_pair_ = 1;          ///< the first pair that no candidate has been run on
  bool over_ = false;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs_;
  std::vector<Scored> last_;  ///< of the last generation, not of the final stage
  std::vector<std::int64_t> elites_;
};

/// Plans generations of `population` x `runs` in a budget, and a final stage of all members.
/// `final_runs` 0 means the numbers published for EvoStick: 20 for 10,000, 100 for 50,000 and
/// 100,000, 500 for 200,000 (ARGoS3-NEAT, params/; docs/methods.md). The remaining runs go to the
/// final stage.
Expected<GenerationPlan> plan_generations(std::int64_t budget, std::int64_t population,
                                          std::int64_t runs, std::int64_t final_runs);

/// The point with the numbers of the plan; unchanged if there is no plan.
SearchPoint planned_by(const Expected<GenerationPlan>& plan, SearchPoint point);

}  // namespace swarmsmith::search
