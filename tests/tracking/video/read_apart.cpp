#include "tests/tracking/video/read_apart.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "tracking/video/frame_source.h"

namespace swarmsmith {
namespace {

std::string track_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "swarmsmith-track";
}

void tell(int to, const std::string& text) {
  if (::write(to, text.data(), text.size()) != static_cast<ssize_t>(text.size())) std::_Exit(3);
}

/// Runs it in a process whose words come through a pipe.
ReadApart apart(const std::function<void(int)>& what) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr rlim_t kMost_s = 20;
    const rlimit limit{kMost_s, kMost_s};
    ::setrlimit(RLIMIT_CPU, &limit);
    ::close(pipe[0]);
    what(pipe[1]);
    std::_Exit(0);
  }
  ::close(pipe[1]);
  ReadApart result;
  std::array<char, 4096> some{};
  for (ssize_t count = 0; (count = ::read(pipe[0], some.data(), some.size())) > 0;)
    result.said.append(some.data(), static_cast<std::size_t>(count));
  ::close(pipe[0]);
  rusage used{};
  ::wait4(child, &result.status, 0, &used);
  result.most_memory_mb = used.ru_maxrss / 1024;
  return result;
}

}  // namespace

ReadApart read_apart(const std::string& word) {
  ReadApart result = apart([&](int to) {
    long frames = 0;
    std::string error;
    auto source = FrameSource::open(word);
    if (!source) error = to_string(source.error());
    while (source) {
      const auto more = (*source)->next();
      if (!more) error = to_string(more.error());
      if (!more || !*more) break;
      ++frames;
    }
    tell(to, std::to_string(frames) + (source && !(*source)->info().oddities.empty() ? "!" : " ") +
                 error);
  });
  std::size_t end = 0;
  if (result.said.empty()) return result;
  result.frames = std::stol(result.said, &end);
  result.is_odd = result.said[end] == '!';
  result.said.erase(0, end + 1);
  return result;
}

bool has_track_program() {
  return std::filesystem::exists(track_program());
}

ReadApart detected_apart(const std::string& word) {
  return apart([&](int to) {
    ::dup2(to, STDERR_FILENO);
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    const std::string program = track_program();
    ::execl(program.c_str(), program.c_str(), "detect", word.c_str(), "--json", "-q", "--csv",
            "/dev/null", nullptr);
    std::_Exit(4);
  });
}

}  // namespace swarmsmith
