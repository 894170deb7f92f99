// storage_benchmark [FILE]: what a store costs. Fills one with a synthetic campaign of 95,000
// experiments as fast as it takes them, and prints CPU and wall time a row, the size, and how long
// each documented view takes. The file stays when it is named.

#include <fmt/format.h>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include "storage/store.h"
#include "tests/support/synthetic_campaign.h"

namespace {

using namespace swarmsmith;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// Everything but the writer sleeps meanwhile, so that the process' CPU time is the writer's.
void fill(const std::filesystem::path& path, SyntheticCampaign campaign, std::size_t in_flight) {
  std::filesystem::remove(path);
  auto store = Store::open(path, campaign.campaign, campaign.designs);
  if (!store) {
    fmt::print(stderr, "{}\n", to_string(store.error()));
    std::exit(1);
  }
  std::size_t evaluations = 0;
  for (const auto& batch : campaign.batches) {
    for (const Row& row : batch)
      evaluations += std::holds_alternative<EvaluationRow>(row) ? 1U : 0U;
  }
  const double cpu = cpu_seconds();
  const auto start = Clock::now();
  std::size_t queued = 0;
  for (auto& batch : campaign.batches) {
    (*store)->append(std::move(batch));
    if (++queued % in_flight == 0) (*store)->flush();
  }
  (*store)->flush();
  const double wall = seconds_since(start);
  const double used = cpu_seconds() - cpu;
  const auto count = static_cast<double>(evaluations);
  fmt::print(
      "{} evaluations, {} batches in flight: {:.2f} us of CPU, {:.2f} us of wall time each\n",
      evaluations, in_flight, used / count * 1e6, wall / count * 1e6);
}

void time_views(StoreReader& reader) {
  std::vector<std::string> names;
  const auto ignore = [](const auto&) {};
  (void)reader.query("SELECT name FROM sqlite_schema WHERE type = 'view' ORDER BY name", {}, ignore,
                     [&](const auto& cells) { names.push_back(cells[0].text); });
  for (const std::string& name : names) {
    const auto start = Clock::now();
    const auto end = reader.query("SELECT * FROM " + name, {}, ignore, ignore);
    fmt::print("{:20} {:8} rows {:7.3f} s\n", name, end ? end->rows : -1, seconds_since(start));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path path =
      argc > 1 ? argv[1] : std::filesystem::temp_directory_path() / "storage_benchmark.db";
  const SyntheticCampaign campaign = synthetic_campaign(kHundredThousand);
  for (const std::size_t in_flight : {std::size_t{1}, std::size_t{4}, std::size_t{1000}}) {
    fill(path, campaign, in_flight);
  }
  fmt::print("{:.2f} MB\n", static_cast<double>(std::filesystem::file_size(path)) / 1e6);

  auto start = Clock::now();
  auto reader = StoreReader::open(path);
  if (!reader) return 1;
  const std::size_t scores = (*reader)->scores().size();
  fmt::print("scores: {} in {:.3f} s\n", scores, seconds_since(start));
  start = Clock::now();
  const std::string digest = (*reader)->digest();
  fmt::print("digest: {} in {:.3f} s\n", digest, seconds_since(start));
  time_views(**reader);
  reader->reset();
  if (argc < 2) std::filesystem::remove(path);
  return 0;
}
