// Bundles sent to hosts that a script plays; real ones are in tests/slurm and
// tests/end_to_end/bundle_test.py.

#include "coordinator/launchers/worker_bundle.h"

#include <sys/wait.h>
#include <fstream>
#include <functional>
#include <thread>

#include "base/process/process.h"
#include "base/text/sha256.h"
#include "coordinator/launchers/ssh_workers.h"
#include "coordinator/launchers/worker_program.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

class Bundles : public testing::Test {
 protected:
  Bundles() {
    // Runs `$1` as a host does, whose cache is `cache`, with its own programs before all others.
    // Both the first bytes that arrive and what comes before the command may be said.
    write("host",
          "#!/bin/sh\n"
          "for word; do last=$word; done\n"
          "export PATH=" +
              folder.path().string() + "/bin:$PATH XDG_CACHE_HOME=" + cache.parent_path().string() +
              "\n"
              "test -n \"$FIRST\" && { head -c \"$FIRST\" | sh -c \"$BEFORE$last\"; exit; }\n"
              "exec sh -c \"$BEFORE$last\"\n");
    fs::create_directory(folder / "bin");
    fs::create_directory(folder / "bundles");
    setenv("SWARMSMITH_BUNDLES", (folder / "bundles").c_str(), 1);
  }
  ~Bundles() override {
    for (const char* name : {"SWARMSMITH_BUNDLES", "FIRST", "BEFORE"})
      unsetenv(name);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    fs::permissions(folder / name, fs::perms(0755));
  }

  struct Said {
    int code = 0;
    std::string output;
    std::string errors;
  };
  static Said run(const std::vector<std::string>& words) {
    const Interrupt never;
    const auto end = run_process({.words = words}, never);
    if (!end) return {-1, "", end.error().message};
    return {end->exit_code, end->output.text, end->errors.text};
  }
  static Said shell(const std::string& line) { return run({"/bin/sh", "-c", line}); }

  /// Packs a worker that does what the text says. The hashes are those of its files before `spoil`.
  void pack(const std::string& worker, const std::string& architecture = "x86_64",
            const std::string& spoil = "") const {
    const std::string name =
        std::string("swarmsmith-worker-") + SWARMSMITH_VERSION + "-" + architecture;
    fs::create_directories(folder / ("work/" + name + "/lib"));
    write("work/" + name + "/swarmsmith-worker", worker);
    std::ofstream(folder / ("work/" + name + "/lib/libbig.so")) << std::string(100'000, 'x');
    const Said packed = shell("cd " + (folder / "work").string() + " && (cd " + name +
                              " && find . -type f -printf '%P\\n' | sort | xargs sha256sum >../S "
                              "&& mv ../S SHA256SUMS; " +
                              spoil + ") && tar --sort=name -cf - " + name +
                              " | xz -0 >../bundles/" + name + ".tar.xz");
    ASSERT_EQ(packed.code, 0) << packed.errors;
  }

  WorkerBundle the_bundle() const {
    const auto bundles = find_bundles();
    EXPECT_TRUE(bundles) << to_string(bundles.error());
    return bundles->front();
  }
  Said send(const WorkerBundle& bundle) const {
    return shell(send_line(bundle, {(folder / "host").string()}));
  }
  /// What is in the cache.
  std::vector<std::string> cached() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(cache, none))
      names.push_back(entry.path().filename().string());
    return names;
  }
  /// Whether all files of the bundle are in the cache, and nothing else.
  void expect_installed(const WorkerBundle& bundle) const {
    EXPECT_THAT(cached(), ElementsAre(bundle.folder));
    const fs::path place = cache / bundle.folder;
    EXPECT_EQ(shell("cd " + place.string() + " && sha256sum -c SHA256SUMS && ls").output,
              "lib/libbig.so: OK\nswarmsmith-worker: OK\nSHA256SUMS\nlib\nswarmsmith-worker\n");
  }

  TemporaryFolder folder;
  const fs::path cache = folder / "c/swarmsmith";
};

TEST_F(Bundles, AreFoundByVersionAndNamedByHash) {
  EXPECT_THAT(
      complaint_of(find_bundles()),
      AllOf(StartsWith((folder / "bundles").string() + ": "),
            HasSubstr("`./dev bundle` makes swarmsmith-worker-"), HasSubstr("SWARMSMITH_BUNDLES")));
  pack("#!/bin/sh\n", "aarch64");
  pack("#!/bin/sh\n");
  const auto bundles = find_bundles();
  ASSERT_TRUE(bundles);
  ASSERT_EQ(bundles->size(), 2);
  EXPECT_EQ(bundles->front().architecture, "x86_64");
  EXPECT_THAT(bundles->front().folder,
              AllOf(HasSubstr("-x86_64-"),
                    EndsWith(sha256_of_file(bundles->front().archive.string())->substr(0, 16))));
  EXPECT_EQ(bundles->back().architecture, "aarch64");

  const fs::path archive = bundles->front().archive;
  fs::resize_file(archive, fs::file_size(archive) / 2);
  EXPECT_THAT(complaint_of(find_bundles()), HasSubstr("x86_64.tar.xz: the bundle is damaged"));
}

TEST_F(Bundles, WhatArrivesInPartIsNotThere) {
  pack("#!/bin/sh\necho runs \"$@\"\n");
  const WorkerBundle bundle = the_bundle();
  const auto size = std::stol(shell("xz -dc '" + bundle.archive.string() + "' | wc -c").output);
  int refused = 0;
  for (long first = 0; first < size; first += first < 1024 ? 512 : 16'000) {
    setenv("FIRST", std::to_string(first).c_str(), 1);
    const Said said = send(bundle);
    if (said.code == 0) {  // zeros alone were missing
      expect_installed(bundle);
      fs::remove_all(cache / bundle.folder);
      continue;
    }
    ++refused;
    EXPECT_THAT(cached(), IsEmpty()) << first;
    EXPECT_THAT(said.errors, EndsWith("\n")) << first;
  }
  EXPECT_GT(refused, 7);
  unsetenv("FIRST");
  const Said said = send(bundle);
  EXPECT_EQ(said.code, 0) << said.errors;
  EXPECT_EQ(said.output, cache.string() + "\n");
  expect_installed(bundle);
  // Nothing is sent twice.
  setenv("FIRST", "0", 1);
  EXPECT_EQ(send(bundle).code, 0);
}

TEST_F(Bundles, WhatIsDamagedOrFindsNoRoomIsNotThere) {
  setenv("BEFORE", "trap '' XFSZ; ulimit -f 100; ", 1);
  pack("#!/bin/sh\n");
  const Said full = send(the_bundle());
  EXPECT_NE(full.code, 0);
  EXPECT_THAT(full.errors, HasSubstr("libbig.so"));
  EXPECT_THAT(cached(), IsEmpty());
  unsetenv("BEFORE");
  pack("#!/bin/sh\n", "x86_64", "echo >>lib/libbig.so");
  const Said damaged = send(the_bundle());
  EXPECT_NE(damaged.code, 0);
  EXPECT_EQ(damaged.errors, "not all of it arrived\n");
  EXPECT_THAT(cached(), IsEmpty());
}

TEST_F(Bundles, ACacheOfWhichPartsAreGoneIsFilledAgain) {
  pack("#!/bin/sh\n");
  const WorkerBundle bundle = the_bundle();
  const fs::path place = cache / bundle.folder;
  const std::string host = (folder / "host").string();
  write("bin/uname", "#!/bin/sh\necho x86_64\n");
  for (const char* gone : {"swarmsmith-worker", "lib/libbig.so", "lib", "SHA256SUMS", ""}) {
    ASSERT_EQ(send(bundle).code, 0) << gone;
    expect_installed(bundle);
    fs::remove_all(place / gone);
    EXPECT_EQ(run({host, shell_line(start_words({bundle}, {}, {}))}).code, kNotInCache) << gone;
  }
  EXPECT_EQ(send(bundle).code, 0);
  // As old as its installation, not as its build: caches are emptied by age.
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(place / "SHA256SUMS");
  EXPECT_LT(age, std::chrono::hours(1));
}

TEST_F(Bundles, WhatAKilledInstallationLeftGoesLater) {
  pack("#!/bin/sh\n");
  fs::create_directories(cache / "new.Ab12/x");
  fs::create_directories(cache / "new.Cd34/x");
  shell("touch -d '2 days ago' '" + (cache / "new.Ab12").string() + "'");
  EXPECT_EQ(send(the_bundle()).code, 0);
  EXPECT_THAT(cached(), testing::UnorderedElementsAre(the_bundle().folder, "new.Cd34"));
}

TEST_F(Bundles, AnotherProgramMayInstallItMeanwhile) {
  pack("#!/bin/sh\n");
  const WorkerBundle bundle = the_bundle();
  // While this one's files are checked, the other one's appear.
  write("bin/sha256sum", "#!/bin/sh\nPATH=${PATH#*:}\nsha256sum \"$@\" && cp -r . " +
                             (cache / bundle.folder).string() + "\n");
  EXPECT_EQ(send(bundle).code, 0);
  expect_installed(bundle);
}

TEST_F(Bundles, AHostStartsWhatItNeeds) {
  pack("#!/bin/sh\necho \"x86_64 $#: $*\"\n");
  pack("#!/bin/sh\necho \"aarch64 $#: $*\"\n", "aarch64");
  const auto bundles = value_of(find_bundles());
  const std::string host = (folder / "host").string();
  const auto start = [&] {
    return run({host, shell_line(start_words(bundles, {}, {"--key", "it's 1"}))});
  };
  for (const WorkerBundle& bundle : bundles) {
    write("bin/uname", "#!/bin/sh\necho " + bundle.architecture + "\n");
    const Said lacking = start();
    EXPECT_EQ(lacking.code, kNotInCache + (&bundle - bundles.data()));
    EXPECT_THAT(lacking.errors, EndsWith(" has no worker for " + bundle.architecture + "\n"));
    ASSERT_EQ(send(bundle).code, 0);
    EXPECT_EQ(start().output, bundle.architecture + " 2: --key it's 1\n");
  }
  write("bin/uname", "#!/bin/sh\necho riscv64\n");
  const Said other = start();
  EXPECT_EQ(other.code, kNoBundle);
  EXPECT_THAT(other.errors, EndsWith(" has no worker for riscv64\n"));
  // From a cache that another host has filled.
  fs::remove(folder / "bin/uname");
  write("bin/uname", "#!/bin/sh\necho x86_64\n");
  setenv("BEFORE", "XDG_CACHE_HOME=/nowhere; ", 1);
  EXPECT_EQ(run({host, shell_line(start_words(bundles, cache, {}))}).output, "x86_64 0: \n");
}

class ShippedBySsh : public Bundles {
 protected:
  ShippedBySsh() {
    write("bin/uname", "#!/bin/sh\necho x86_64\n");
    pack("#!/bin/sh\necho >>" + (folder / "started").string() +
         "\necho swarmsmith-worker: connected\nexec cat\n");
  }

  /// The script runs in place of ssh before `host` does, with $host, and $sends for a bundle.
  SshWorkers start(std::vector<SshHost> hosts, const std::string& script = "") {
    write("ssh",
          "#!/bin/sh\nfor word; do host=$last; last=$word; done\n"
          "case $last in *mktemp*) sends=1;; *) sends=;; esac\n" +
              script + "test -n \"$sends\" && echo $host >>" + (folder / "log").string() +
              "\nexec " + (folder / "host").string() + " \"$last\"\n");
    auto bundles = find_bundles();
    EXPECT_TRUE(bundles);
    auto workers = SshWorkers::start({.hosts = std::move(hosts),
                                      .address = {.endpoint = "tcp://h:1"},
                                      .bundles = *bundles,
                                      .ssh = (folder / "ssh").string(),
                                      .first_pause = std::chrono::milliseconds(1),
                                      .longest_pause = std::chrono::milliseconds(20)});
    EXPECT_TRUE(workers);
    return std::move(*workers);
  }

  static void wait_for(SshWorkers& workers, const std::function<bool(const std::string&)>& holds) {
    ASSERT_TRUE(eventually([&] { return holds(workers.tend(SystemClock().now())); }))
        << workers.status().note;
  }
  void wait_for_started(SshWorkers& workers, std::uintmax_t count) const {
    std::error_code none;
    wait_for(workers, [&](const std::string&) {
      return fs::file_size(folder / "started", none) == count && !none &&
             workers.status().running == workers.status().wanted;
    });
  }

  std::string log() const { return shell("cat " + (folder / "log").string()).output; }
};

TEST_F(ShippedBySsh, HostsThatShareACacheGetOne) {
  SshWorkers workers = start({{"a"}, {"b"}, {"c"}});
  wait_for_started(workers, 3);
  EXPECT_EQ(workers.status().note, "");
  EXPECT_THAT(log(), testing::AnyOf("a\n", "b\n", "c\n"));
  expect_installed(the_bundle());
  workers.stop(std::chrono::seconds(60));
  SshWorkers again = start({{"a"}, {"b"}});
  wait_for_started(again, 5);
  EXPECT_EQ(log().size(), 2) << "and none for the next campaign";
}

TEST_F(ShippedBySsh, AHostThatLookedBeforeTheBundleCameLooksAgain) {
  const std::string looked = (folder / "looked").string();
  const std::string started = (folder / "started").string();
  SshWorkers workers =
      start({{"a"}, {"b"}, {"c"}}, "if test $host = c && test ! -e " + looked + "; then touch " +
                                       looked + "; " + (folder / "host").string() +
                                       " \"$last\"; code=$?; until test $(cat " + started +
                                       " | wc -l) = 2; do sleep 0.01; done; exit $code; fi\n");
  wait_for_started(workers, 3);
  EXPECT_THAT(log(), testing::AnyOf("a\n", "b\n"));
}

TEST_F(ShippedBySsh, HostsWithCachesOfTheirOwnGetOneEach) {
  SshWorkers workers =
      start({{"a"}, {"b"}, {"c"}},
            "export BEFORE=\"XDG_CACHE_HOME=" + (folder / "own").string() + "/$host; \"\n");
  wait_for_started(workers, 3);
  EXPECT_EQ(log().size(), 6);
}

TEST_F(ShippedBySsh, AnotherTryIsMadeWhenSendingFails) {
  SshWorkers workers = start({{"a"}}, "test -n \"$sends\" && test ! -e " +
                                          (folder / "log").string() + " && export FIRST=51200\n");
  wait_for(workers, [&](const std::string&) {
    return workers.status().note.starts_with("a: the worker cannot be sent there: tar: ");
  });
  wait_for_started(workers, 1);
  EXPECT_EQ(log(), "a\na\n");
  expect_installed(the_bundle());
}

TEST_F(ShippedBySsh, SshMayHaveTheLastWord) {
  // With options such as -v.
  SshWorkers workers =
      start({{"a"}}, (folder / "host").string() +
                         " \"$last\"; code=$?; echo debug1: Exit status $code >&2; exit $code\n");
  wait_for_started(workers, 1);
  expect_installed(the_bundle());
}

TEST_F(ShippedBySsh, AFolderThatRunsNoProgramsIsNamed) {
  ASSERT_EQ(send(the_bundle()).code, 0);
  fs::permissions(cache / the_bundle().folder / "swarmsmith-worker", fs::perms(0644));
  SshWorkers workers = start({{"a"}});
  wait_for(workers, [&](const std::string&) {
    return workers.status().note.starts_with(
        "a: the worker cannot be run there; if its folder is ");
  });
  EXPECT_EQ(log(), "") << "and it is not sent for that";
}

TEST_F(ShippedBySsh, AHostOfAnUnknownKindIsRefused) {
  write("bin/uname", "#!/bin/sh\necho riscv64\n");
  write("mine", "#!/bin/sh\necho swarmsmith-worker: connected\nexec cat\n");
  SshWorkers workers = start({{"a"}, {.name = "b", .program = folder / "mine"}});
  wait_for(workers, [&](const std::string&) {
    // A program of its own needs no bundle.
    return workers.status().running == 1 &&
           workers.status().note.starts_with("a: there is no bundle for its architecture in " +
                                             (folder / "bundles").string());
  });
  SshWorkers alone = start({{"a"}});
  wait_for(alone, [](const std::string& trouble) {
    return trouble.starts_with("ssh: a: there is no bundle for its architecture in ");
  });
  EXPECT_EQ(log(), "");
}

TEST_F(ShippedBySsh, WhatVanishesIsNotSentInALoop) {
  SshWorkers workers = start({{"a"}}, "test -n \"$sends\" || rm -rf " + cache.string() + "\n");
  wait_for(workers, [&](const std::string&) {
    return workers.status().note.starts_with("a: the worker was sent there, but cannot be found");
  });
  EXPECT_EQ(log(), "a\n");
}

}  // namespace
}  // namespace swarmsmith
