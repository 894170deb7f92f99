// storage_benchmark [DESIGNS [FILE]]: the cost of a store, and the speed of its views. Fills a
// store with one synthetic design of 100,000 experiments as fast as the store accepts them, then
// another with DESIGNS of them (30: 3 million experiments), and reads every documented view,
// completely and for one design. The last file is kept if FILE is given; otherwise it is in the
// folder for temporary files.

#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "storage/store.h"
#include "tests/support/synthetic_campaign.h"

namespace {

using namespace swarmsmith;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// CPU time of the whole process, which is more reliable than wall time on a machine that others
/// use, too.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

std::size_t count_evaluations(const std::vector<std::vector<Row>>& batches) {
  std::size_t count = 0;
  for (const auto& batch : batches) {
    for (const Row& row : batch)
      count += std::holds_alternative<EvaluationRow>(row) ? 1U : 0U;
  }
  return count;
}

/// Fills the store design by design. Only the writer runs while a design is stored, so that the
/// process's CPU time is the writer's.
void fill(const fs::path& path, std::int64_t designs, std::size_t in_flight) {
  fs::remove(path);
  SyntheticSize size = kHundredThousand;
  size.designs = designs;
  const SyntheticCampaign header = synthetic_header(size);
  auto store = Store::open(path, header.campaign, header.designs);
  if (!store) {
    fmt::print(stderr, "{}\n", to_string(store.error()));
    std::exit(1);
  }
  double cpu = 0, wall = 0;
  std::size_t evaluations = 0;
  for (const DesignRow& design : header.designs) {
    auto batches = synthetic_design(size, design.id);
    evaluations += count_evaluations(batches);
    const double cpu_before = cpu_seconds();
    const auto start = Clock::now();
    std::size_t queued = 0;
    for (auto& batch : batches) {
      (*store)->append(std::move(batch));
      if (++queued % in_flight == 0) (*store)->flush();
    }
    (*store)->flush();
    wall += seconds_since(start);
    cpu += cpu_seconds() - cpu_before;
  }
  store->reset();
  const auto count = static_cast<double>(evaluations);
  const auto bytes = static_cast<double>(fs::file_size(path));
  fmt::print("{:9} {:9} {:12.2f} {:13.2f} {:9.1f} {:14.1f}\n", evaluations, in_flight,
             cpu / count * 1e6, wall / count * 1e6, bytes / 1e6, bytes / count);
}

std::vector<std::string> views_of(StoreReader& reader) {
  std::vector<std::string> names;
  (void)reader.query(
      "SELECT name FROM sqlite_schema WHERE type = 'view' AND name GLOB 'v_*' ORDER BY name", {},
      [](const auto&) {}, [&](const auto& cells) { names.push_back(cells[0].text); });
  return names;
}

bool has_column(StoreReader& reader, const std::string& view, const std::string& column) {
  bool has = false;
  (void)reader.query(
      fmt::format("SELECT 1 FROM pragma_table_info('{}') WHERE name = '{}'", view, column), {},
      [](const auto&) {}, [&](const auto&) { has = true; });
  return has;
}

struct Reading {
  std::int64_t rows = 0;
  double seconds = 0;
  double cpu = 0;
};

Reading read(StoreReader& reader, const std::string& sql) {
  const auto ignore = [](const auto&) {};
  const double cpu = cpu_seconds();
  const auto start = Clock::now();
  const auto end = reader.query(
      sql, {.rows = std::numeric_limits<std::int64_t>::max(), .seconds = 1e6}, ignore, ignore);
  if (!end) fmt::print(stderr, "{}\n", to_string(end.error()));
  return {end ? end->rows : -1, seconds_since(start), cpu_seconds() - cpu};
}

void time_views(const fs::path& path) {
  auto start = Clock::now();
  auto reader = StoreReader::open(path);
  if (!reader) std::exit(1);
  const std::string digest = (*reader)->digest();
  fmt::print("digest {}: {:.2f} s\n\n", digest, seconds_since(start));
  const std::int64_t design = (static_cast<std::int64_t>((*reader)->designs().size()) + 1) / 2;
  const auto print = [](const Reading& r) {
    fmt::print(" {:9} {:8.3f} {:8.3f}", r.rows, r.seconds, r.cpu);
  };
  fmt::print("{:19}", "view");
  for (const char* what : {"rows", "of 1 design"})
    fmt::print(" {:>11} {:>6} {:>8}", what, "s", "s of CPU");
  fmt::print("\n");
  for (const std::string& name : views_of(**reader)) {
    fmt::print("{:19}", name);
    print(read(**reader, "SELECT * FROM " + name));
    if (has_column(**reader, name, "design"))
      print(read(**reader, fmt::format("SELECT * FROM {} WHERE design = {}", name, design)));
    fmt::print("\n");
  }
}

void print_costs_header() {
  fmt::print("{:>9} {:>9} {:>12} {:>13} {:>9} {:>14}\n", "scores", "in flight", "us of CPU each",
             "us each", "MB", "bytes each");
}

}  // namespace

int main(int argc, char** argv) {
  const std::int64_t designs = argc > 1 ? std::max(1L, std::atol(argv[1])) : 30;
  const fs::path path =
      argc > 2 ? fs::path(argv[2])
               : fs::temp_directory_path() / fmt::format("storage_benchmark-{}.db", ::getpid());
  print_costs_header();
  for (const std::size_t in_flight : {std::size_t{1}, std::size_t{4}, std::size_t{1000}})
    fill(path, 1, in_flight);
  time_views(path);
  fmt::print("\n");
  if (designs > 1) {
    print_costs_header();
    fill(path, designs, 1000);
    time_views(path);
  }
  if (argc < 3) fs::remove(path);
  return 0;
}
