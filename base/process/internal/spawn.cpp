#include "base/process/internal/spawn.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "base/process/guard.h"

namespace swarmsmith {
namespace {

/// Everything that the child needs, prepared before it exists: until it runs its program it may
/// neither allocate memory nor lock.
struct Birth {
  const char* program = nullptr;
  char* const* words = nullptr;
  char* const* shell_words = nullptr;  ///< the same for /bin/sh
  const char* folder = nullptr;        ///< null: the current folder
  int input = -1;
  int output = -1;
  int errors = -1;
  pid_t parent = 0;
  int death_signal = SIGKILL;  ///< the signal to the program when its parent dies
  // Written by the child, in the memory that both share until the program runs.
  volatile int error = 0;
  const char* volatile step = "";
};

[[noreturn]] void give_up(Birth& birth, const char* step) {
  birth.step = step;
  birth.error = errno;
  _exit(127);
}

[[noreturn]] void become(Birth& birth) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, birth.death_signal);
  if (getppid() != birth.parent) _exit(127);
  // Done by the child before it runs the program, since the parent may be killed at this moment.
  guard(getpid());
  if (birth.folder != nullptr && chdir(birth.folder) != 0) give_up(birth, "its folder");
  if (dup2(birth.input, 0) < 0 || dup2(birth.output, 1) < 0 || dup2(birth.errors, 2) < 0) {
    give_up(birth, "its pipes");
  }
  close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  // Programs would inherit the signals that this process ignores.
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  for (const int number :
       {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGCHLD, SIGUSR1, SIGUSR2, SIGXFSZ})
    sigaction(number, &action, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execve(birth.program, birth.words, environ);
  if (errno == ENOEXEC) execve("/bin/sh", birth.shell_words, environ);
  give_up(birth, "");
}

/// Uses vfork: a fork would copy the page tables of the threads of all slots, and fail when memory
/// is short. The child runs on this stack, so nothing else may happen in this function.
[[gnu::noinline]] pid_t begin(Birth& birth) {
  const pid_t pid = vfork();  // NOLINT(clang-analyzer-security.insecureAPI.vfork): see above
  if (pid == 0)
    become(birth);  // NOLINT(clang-analyzer-unix.Vfork): it calls only async-signal-safe functions
  return pid;
}

/// Blocks signals, so that no handler of this process runs in the child while both share memory.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

/// Moves a descriptor above the three numbers that the child needs for its own standard streams.
Descriptor above_the_standard(int number) {
  Descriptor low(number);
  if (number < 0 || number > 2) return low;
  return Descriptor(fcntl(number, F_DUPFD_CLOEXEC, 3));
}

bool make_pipe(Descriptor& reader, Descriptor& writer) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  reader = Descriptor(ends[0]);
  writer = above_the_standard(ends[1]);
  fcntl(reader.get(), F_SETFL, O_NONBLOCK);
  return writer.get() >= 0;
}

std::vector<char*> argument_pointers(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (const std::string& word : words)
    pointers.push_back(
        const_cast<char*>(word.c_str()));  // execve's signature; it does not change the text
  pointers.push_back(nullptr);
  return pointers;
}

/// Whether the first line ends in CR as in Windows: the system then looks for a program whose name
/// ends in CR.
bool first_line_ends_with_cr(const std::string& program) {
  std::ifstream file(program, std::ios::binary);
  std::array<char, 256> begin{};
  file.getline(begin.data(), begin.size());
  return std::string_view(begin.data()).ends_with('\r');
}

Unexpected cannot(const std::string& program, const Birth& birth) {
  const std::string step = birth.step;
  std::string why = std::strerror(birth.error);
  if (birth.error == ENOENT && step.empty() && access(program.c_str(), F_OK) == 0) {
    why = first_line_ends_with_cr(program)
              ? "its lines end as on Windows, with a carriage return: convert it (dos2unix)"
              : "the program that its first line (#!) names does not exist";
  } else if (birth.error == EACCES && step.empty() && access(program.c_str(), X_OK) != 0) {
    why = "it is not executable (chmod +x)";
  } else if (birth.error == E2BIG) {
    why = "its command line is longer than this system allows";
  } else if (birth.folder != nullptr && step == "its folder") {
    why = "its folder " + std::string(birth.folder) + ": " + why;
  }
  return unexpected(ErrorKind::Unavailable, program + " cannot be started: " + why);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    reset();
    number_ = other.release();
  }
  return *this;
}

int Descriptor::release() {
  return std::exchange(number_, -1);
}

void Descriptor::reset() {
  if (number_ >= 0) close(release());
}

Expected<Child> spawn(const std::string& program, const std::vector<std::string>& words,
                      const std::string& folder) {
  const std::vector<char*> pointers = argument_pointers(words);
  std::vector<std::string> through_shell{"sh", program};
  through_shell.insert(through_shell.end(), words.begin() + 1, words.end());
  const std::vector<char*> shell_pointers = argument_pointers(through_shell);

  Child child;
  Descriptor output;
  Descriptor errors;
  const Descriptor input = above_the_standard(open("/dev/null", O_RDONLY | O_CLOEXEC));
  Birth birth{.program = program.c_str(),
              .words = pointers.data(),
              .shell_words = shell_pointers.data(),
              .folder = folder.empty() ? nullptr : folder.c_str(),
              .parent = getpid(),
              // The guard ensures that the group ends.
              .death_signal = is_guarded() ? SIGTERM : SIGKILL};
  if (input.get() < 0 || !make_pipe(child.output, output) || !make_pipe(child.errors, errors)) {
    birth.error = errno;
    return cannot(program, birth);
  }
  birth.input = input.get();
  birth.output = output.get();
  birth.errors = errors.get();
  {
    const SignalsBlocked blocked;
    child.pid = begin(birth);
  }
  if (child.pid < 0) birth.error = errno;
  if (birth.error != 0) {
    if (child.pid > 0) {
      unguard(child.pid);
      waitpid(child.pid, nullptr, 0);
    }
    return cannot(program, birth);
  }
  // Called directly, since glibc 2.36 declares the wrapper for C only.
  child.ended = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, child.pid, 0)));
  return child;
}

}  // namespace swarmsmith
