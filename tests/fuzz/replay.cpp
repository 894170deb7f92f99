// Runs a target without libFuzzer, in the ordinary tests: over its seeds as they are, cut short,
// and with some bytes changed, always the same ones.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "base/rng.h"
#include "tests/fuzz/fuzz.h"

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::set<fs::path> files_below(const fs::path& path) {
  std::set<fs::path> files;
  if (!fs::is_directory(path)) return {path};
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.insert(entry.path());
  }
  return files;
}

std::string changed(std::string text, swarmsmith::Rng& rng) {
  constexpr std::string_view kTelling = "\"'\\#|&()[]{}<>=!+-*/%^:,;.0123456789eLTN \t\n\r\x80\xff";
  for (std::uint64_t i = 1 + rng.below(4); i > 0 && !text.empty(); --i) {
    const std::size_t at = rng.below(text.size());
    const char c = kTelling[rng.below(kTelling.size())];
    switch (rng.below(3)) {
      case 0:
        text[at] = c;
        break;
      case 1:
        text.insert(text.begin() + static_cast<std::ptrdiff_t>(at), c);
        break;
      default:
        text.erase(at, 1 + rng.below(8));
        break;
    }
  }
  return text;
}

}  // namespace

int main(int count, char** arguments) {
  constexpr int kChanges = 8;
  swarmsmith::Rng rng(1);
  int inputs = 0;
  for (int i = 1; i < count; ++i) {
    for (const fs::path& file : files_below(arguments[i])) {
      const std::string text = content(file);
      swarmsmith::fuzz::run(text);
      for (int n = 0; n < kChanges; ++n) {
        swarmsmith::fuzz::run(changed(text, rng));
        swarmsmith::fuzz::run(text.substr(0, rng.below(text.size() + 1)));
      }
      inputs += 1 + 2 * kChanges;
    }
  }
  std::printf("%d inputs\n", inputs);
  return inputs > 0 ? 0 : 1;
}
