#include "base/process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace swarmsmith {
namespace {

constexpr std::size_t kLongestLine = 500;

void close_one(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

/// A pipe whose ends no other child inherits.
struct Pipe {
  int read = -1;
  int write = -1;

  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
    read = ends[0];
    write = ends[1];
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_one(read);
    close_one(write);
  }
};

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts)
    pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

int spawn(std::vector<std::string> words, const posix_spawn_file_actions_t* streams,
          std::vector<std::string> variables, pid_t& pid) {
  const std::vector<char*> arguments = pointers_to(words);
  for (char** variable = environ; *variable != nullptr; ++variable)
    variables.emplace_back(*variable);
  const std::vector<char*> environment = pointers_to(variables);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int failed = posix_spawnp(&pid, arguments.front(), streams, &attributes, arguments.data(),
                                  environment.data());
  posix_spawnattr_destroy(&attributes);
  return failed;
}

}  // namespace

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)),
      input_(std::exchange(other.input_, -1)),
      output_(std::exchange(other.output_, -1)),
      errors_(std::exchange(other.errors_, -1)),
      line_(std::move(other.line_)),
      last_line_(std::move(other.last_line_)),
      lines_(std::move(other.lines_)) {}

ChildProcess::~ChildProcess() {
  finish_by({});
}

Expected<void> ChildProcess::start(const std::vector<std::string>& words, Streams streams,
                                   const std::vector<std::string>& variables) {
  close_streams();
  line_.clear();
  last_line_.clear();
  lines_.clear();
  int failed = 0;
  if (streams == Streams::Inherited) {
    failed = spawn(words, nullptr, variables, pid_);
  } else {
    Pipe input;
    Pipe words_of_it;
    if (input.write < 0 || words_of_it.write < 0) {
      return unexpected(ErrorKind::Unavailable,
                        std::string("cannot be started: ") + std::strerror(errno), words.front());
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input.read, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, words_of_it.write, STDOUT_FILENO);
    if (streams == Streams::Held) {
      posix_spawn_file_actions_adddup2(&actions, words_of_it.write, STDERR_FILENO);
    }
    failed = spawn(words, &actions, variables, pid_);
    posix_spawn_file_actions_destroy(&actions);
    if (failed == 0) {
      input_ = std::exchange(input.write, -1);
      int& kept = streams == Streams::Held ? errors_ : output_;
      kept = std::exchange(words_of_it.read, -1);
      if (streams == Streams::Held) fcntl(errors_, F_SETFL, O_NONBLOCK);
    }
  }
  if (failed == 0) return {};
  pid_ = 0;
  return unexpected(ErrorKind::Unavailable,
                    std::string("cannot be started: ") + std::strerror(failed), words.front());
}

std::optional<int> ChildProcess::ended() {
  int status = 0;
  if (pid_ <= 0 || waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = 0;
  read_lines(true);
  end_line(true);
  close_streams();
  return status;
}

void ChildProcess::signal(int number) const {
  if (pid_ > 0) kill(pid_, number);
}

void ChildProcess::end_input() {
  close_one(input_);
}

void ChildProcess::read_lines(bool wanted) {
  // The limit stops reading from a process that writes without end. It is more than a pipe holds,
  // so that nothing is left of a process that has ended.
  constexpr int kPiecesAtOnce = 64;
  std::array<char, 4096> buffer{};
  for (int piece = 0; piece < kPiecesAtOnce && errors_ >= 0; ++piece) {
    const ssize_t size = read(errors_, buffer.data(), buffer.size());
    if (size <= 0) break;
    for (ssize_t i = 0; i < size; ++i) {
      const char letter = buffer[static_cast<std::size_t>(i)];
      if (letter != '\n' && letter != '\r') {
        if (line_.size() < kLongestLine) line_ += letter;
      } else {
        end_line(wanted);
      }
    }
  }
}

void ChildProcess::end_line(bool wanted) {
  if (line_.empty()) return;
  last_line_ = std::exchange(line_, {});
  if (wanted) lines_.push_back(last_line_);
}

const std::string& ChildProcess::last_line() {
  read_lines(false);
  return last_line_;
}

std::vector<std::string> ChildProcess::take_lines() {
  read_lines(true);
  return std::exchange(lines_, {});
}

void ChildProcess::finish_by(TimePoint until) {
  while (runs() && !ended()) {
    if (SystemClock().now() >= until) {
      kill(-pid_, SIGKILL);  // also the programs of a shell
      int status = 0;
      waitpid(pid_, &status, 0);
      pid_ = 0;
      break;
    }
    last_line();  // reads the output, since a full pipe would keep the process from ending
    poll(nullptr, 0, 5);
  }
  close_streams();
}

void ChildProcess::close_streams() {
  close_one(input_);
  close_one(output_);
  close_one(errors_);
}

Duration Backoff::next() {
  pause_ = std::clamp(2 * pause_, first_, longest_);
  const double factor = jitter_.uniform(0.75, 1.25);
  return std::chrono::duration_cast<Duration>(pause_ * factor);
}

}  // namespace swarmsmith
