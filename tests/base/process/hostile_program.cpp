// Does what its arguments say, one after the other: what targets do by accident.

#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

void say(int descriptor, const std::string& text) {
  std::string_view left = text;
  while (!left.empty()) {
    const ssize_t written = write(descriptor, left.data(), left.size());
    if (written <= 0) return;
    left.remove_prefix(static_cast<std::size_t>(written));
  }
}

[[noreturn]] void sleep_for_ever() {
  while (true)
    pause();
}

/// A grandchild that sleeps and keeps all that this process has.
void leave_grandchild() {
  const pid_t child = fork();
  if (child == 0) sleep_for_ever();
  say(2, std::to_string(child) + "\n");
}

void flood(std::size_t bytes) {
  const std::string block(65536, 'x');
  for (std::size_t sent = 0; sent < bytes; sent += block.size())
    say(1, block);
}

bool act(std::string_view word, const std::string& value) {
  if (word == "--print") {
    say(1, value + "\n");
  } else if (word == "--complain") {
    say(2, value + "\n");
  } else if (word == "--flood") {
    flood(std::stoul(value));
  } else if (word == "--nul") {
    say(1, std::string("1\0 2\n", 5));
  } else if (word == "--close") {
    close(std::stoi(value));
  } else if (word == "--raise") {
    raise(std::stoi(value));
  } else if (word == "--exit") {
    _exit(std::stoi(value));
  } else if (word == "--ignore") {
    std::signal(std::stoi(value), SIG_IGN);
  } else if (word == "--grandchild") {
    leave_grandchild();
  } else if (word == "--hang") {
    sleep_for_ever();
  } else if (word == "--descriptors") {
    for (int i = 3; i < 1024; ++i) {
      if (write(i, "", 0) == 0 || lseek(i, 0, SEEK_CUR) >= 0) say(1, std::to_string(i) + "\n");
    }
  } else if (word == "--input") {
    char byte = 0;
    say(1, std::to_string(read(0, &byte, 1)) + "\n");
  } else if (word == "--pipe-default") {
    struct sigaction action = {};
    sigaction(SIGPIPE, nullptr, &action);
    say(1, action.sa_handler == SIG_DFL ? "yes\n" : "no\n");
  } else {
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    act(argv[i], value);
  }
  return 0;
}
