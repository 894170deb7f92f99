# shellcheck shell=bash
# The gates of `./dev gate`: all checks of a tree of files. ./dev includes this file, which uses its functions. A gate
# is a function; it ends by writing a number for the table to file descriptor 3. A gate is green for a tree or not. Once
# it is green, build-gate/TREE has the file GATE.row, its line of the table. Before that, GATE.done lists the parts that
# are already green, one line for each test, unit or target. Logs are build-gate/GATE.log.

all_gates=(format tidy test long debug clang asan tsan fuzz debian13)

what_runs() {
  case $1 in
    format) echo "clang-format; types of the pages; plain words" ;;
    tidy) echo "clang-tidy, without tests" ;;
    test) echo "tests, release build" ;;
    long) echo "long tests, release build" ;;
    debug) echo "hashes of trajectories, not optimised" ;;
    clang) echo "hashes of trajectories, clang" ;;
    asan) echo "tests, AddressSanitizer and UBSan" ;;
    tsan) echo "tests, ThreadSanitizer" ;;
    fuzz) echo "fuzz targets, $fuzz_seconds s of processor each" ;;
    debian13) echo "tests in Debian 13, and beside its R and this system" ;;
    *) return 1 ;;
  esac
}

packages_for() {
  case $1 in
    format) install_missing "${lint_packages[@]}" ;;
    test | tsan) install_test_packages ;;
    long) install_test_packages; install_for_tests "${r_packages[@]}" "${snippet_packages[@]}" "${aarch64_packages[@]}" \
      "${package_packages[@]}" "${bare_packages[@]}" ;;
    asan) install_test_packages; install_missing "${lint_packages[@]}" ;;
    debian13) install_missing "${root_packages[@]}"; install_build_packages ;;
    *) install_build_packages "${test_packages[@]}" "${lint_packages[@]}" ;;
  esac
}

fuzz_seconds=${SWARMSMITH_FUZZ_SECONDS:-20}

# The digest of all files, including those that are not in any commit yet.
tree_digest() {
  local index=$PWD/build-gate/index
  cp -p "$(git rev-parse --git-dir)/index" "$index"  # git sees from its time which files it must read
  GIT_INDEX_FILE=$index git add -A && GIT_INDEX_FILE=$index git write-tree | cut -c 1-16
}

# Each version of clang-format formats some lines differently.
format_version=14
is_our_format() { [[ $(clang-format --version) == *" version $format_version."* ]]; }

gate_format() {
  tsc -p web
  python3 tests/gates/plain_words.py
  is_our_format || { echo "types alone: the format is that of clang-format $format_version" >&3; return 0; }
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
  git ls-files '*.h' '*.cpp' | wc -l | sed 's/$/ files/' >&3
}

# Checks the units of the asan build, except for those of tests and those that protoc writes, and with them the headers
# that they include: the analyser treats the files of a unit as headers. It follows 25,000 steps of a function's paths
# (its own default is 225,000): nearly all functions that need more spend them in the standard library and in fmt, and
# they took two thirds of the time.
gate_tidy() {
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target swarmsmith_pb
  sed -n 's/^ *"file": "\(.*\)".*/\1/p' build-asan/compile_commands.json | grep -v '/tests/\|\.pb\.cc$\|_verify_interface_\|\.S$' |
    sort -u >build-gate/units
  { grep -vxFf "$gate_done" build-gate/units || true; } | xargs -r -P "$jobs" -I{} sh -c 'clang-tidy -p build-asan --quiet \
    --checks=-bugprone-suspicious-include --extra-arg=-Xclang --extra-arg=-analyzer-opt-analyze-headers \
    --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=max-nodes=25000 "$1" && echo "$1" >>"$2"' \
    sh {} "$gate_done"
  echo "$(wc -l <build-gate/units) units" >&3
}

# Tests wait for processes and clocks half of their time, so twice as many run in parallel as there are cores.
test_jobs() { echo $((2 * jobs)); }

# tests_gate FOLDER [CTEST-ARGUMENT...]: runs the tests that are not green yet, by their numbers. Sanitizers write their
# reports to files, also those of processes that are killed; any report makes the gate red, even if all tests pass.
tests_gate() {
  local folder=$1 open reports=${gate_done%.done}-reports status=0
  shift
  open=$(ctest --test-dir "$folder" -N "$@" | sed -n 's/^ *Test *#\([0-9]*\): .*/\1/p' | grep -vxFf "$gate_done" | paste -sd,) || true
  mkdir -p "$reports"
  [ -z "$open" ] || ASAN_OPTIONS=log_path=$reports/report UBSAN_OPTIONS=print_stacktrace=1:log_path=$reports/report \
    TSAN_OPTIONS=log_path=$reports/report:suppressions=$PWD/tests/thread_sanitizer.supp \
    ctest --test-dir "$folder" --output-on-failure -j "$(test_jobs)" -I "0,0,0,$open" | tee >(cat >&2) |
    sed -nu 's/.*Test *#\([0-9]*\): .* \(Passed\|\*\*\*Skipped\) .*/\1/p' >>"$gate_done" || status=$?
  find "$reports" -type f -exec cat {} + | sed -n 1,400p  # head would end find, and so the gate
  [ -z "$(ls "$reports")" ] || status=1
  echo "$(sort -u "$gate_done" | wc -l) of $(ctest --test-dir "$folder" -N "$@" | sed -n 's/^Total Tests: //p') tests" >&3
  return "$status"
}

# Tests, except for the long ones, write into memory if there is room: on a disk, they wait for it most of their time.
# Files left by a run that was killed are removed first: the name of a folder contains the process.
write_into_memory() {
  local left process
  for left in /dev/shm/swarmsmith-tests.*.*; do
    process=${left#*swarmsmith-tests.}
    [ -O "$left" ] && ! kill -0 "${process%%.*}" 2>/dev/null && rm -rf "$left"
  done
  if [ -w /dev/shm ] && [ "$(df --output=avail -B 1M /dev/shm | tail -n 1)" -ge 4096 ]; then
    TMPDIR=$(mktemp -d "/dev/shm/swarmsmith-tests.$BASHPID.XXXXXX")
    chmod 755 "$TMPDIR"  # some tests change to another user
    export TMPDIR
    trap 'rm -rf "$TMPDIR"' EXIT
  fi
}

gate_test() {
  build_all
  write_into_memory
  tests_gate build -LE long
}

gate_long() {
  build_all
  [ -n "$(missing_of "${aarch64_packages[@]}")" ] || build_aarch64
  SWARMSMITH_LONG=1 tests_gate build -L 'long|wide'
}

# Checks for the same bits without optimisation, and from another compiler.
hashes_gate() {
  configure "build-$1" --preset "$1"
  cmake --build "build-$1" -j "$jobs" --target sim_engine_test
  "build-$1/bin/sim_engine_test" --gtest_filter='Determinism*' | tee build-gate/hashes
  sed -n 's/^\[  PASSED  \] \([0-9]*\) tests*\..*/\1 tests/p' build-gate/hashes >&3
}
gate_debug() { hashes_gate debug; }
gate_clang() { hashes_gate clang; }

# sanitizer_gate NAME TESTS: builds and runs the ordinary tests except for these (a regular expression).
sanitizer_gate() {
  local without=$2
  configure "build-$1" --preset "$1"
  ninja -C "build-$1" -t targets all | sed -n 's/^\(bin\/[^:]*\):.*/\1/p' | grep -vE "^bin/(fuzz_.*|($without)_test)$" |
    xargs cmake --build "build-$1" -j "$jobs" --target
  SWARMSMITH_SANITIZER=$1 tests_gate "build-$1" -LE long -E "^($without)$"
}

# The gate fuzz runs the fuzz targets with this sanitizer.
gate_asan() { sanitizer_gate asan 'fuzz[.].*'; }

# ThreadSanitizer can find nothing in programs that cannot start a thread.
gate_tsan() {
  local program without='fuzz[.].*'
  build_all
  for program in build/bin/*_test; do
    nm -D --undefined-only "$program" | grep -q 'pthread_create\|_M_start_thread\|zmq_ctx_new' ||
      without+="|$(basename "$program" _test)"
  done
  sanitizer_gate tsan "$without"
}

# Runs each target from its seeds and from the inputs that earlier runs have kept.
gate_fuzz() {
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target fuzzers
  mkdir -p build-fuzz/found
  { grep -vf <(sed 's/.*/^& /' "$gate_done") build-asan/fuzzers.txt || true; } |
    xargs -r -P 2 -L 1 tests/fuzz/run_one "$fuzz_seconds" "$gate_done"
  echo "$(wc -l <build-asan/fuzzers.txt) targets" >&3
}

# Does the same as CI in a bare Debian 13. Then it runs the comparisons with R's irace against irace 4.2 of that system,
# and the test with the programs of both systems. The root stays in build-debian13, with its packages and build results.
gate_debian13() {
  local root=$PWD/build-debian13/root clone=home/swarmsmith
  if [ ! -e "$root/$clone" ]; then
    rm -rf "$root"
    mkdir -p build-debian13
    as_root mmdebstrap --variant=minbase --include=ca-certificates trixie "$root" "$(debian_mirror)"
    mkdir "$root/$clone"
  fi
  build_programs all
  rsync -a --delete --exclude='/build*' ./ "$root/$clone/"
  tests/gates/in_root "$root" bash -c "cd /$clone && SWARMSMITH_WERROR=ON .ci/run" | tee build-gate/debian13-tests
  sed -n 's/.*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\).*/\2 tests, \1 failed/p' build-gate/debian13-tests >&3
  tests/gates/in_root "$root" bash -c "apt-get install -q -y --no-install-recommends ${r_packages[*]} && cd /$clone &&
    SWARMSMITH_LONG=1 ctest --test-dir build --output-on-failure -R '^long.*(against_r|irace_log|irace_rdata)\$'"
  SWARMSMITH_OTHER_ROOT=$root SWARMSMITH_OTHER_BIN=/$clone/build/bin SWARMSMITH_BIN=$PWD/build/bin \
    SWARMSMITH_SOURCE=$PWD python3 tests/long/two_systems_test.py -v
}

# run_gate TREE NAME: it must be called as a separate command, not as a condition, so that its subshell ends at the
# first command that fails.
run_gate() {
  local tree=$1 name=$2 place=build-gate/$1 log=build-gate/$2.log began=$SECONDS status number
  [ ! -e "$place/$name.row" ] || { say "$name: green already"; return; }
  say "$name: $(what_runs "$name"); see $log"
  gate_done=$PWD/$place/$name.done
  touch "$gate_done"
  set +e
  number=$(set -e; exec 3>&1 >"$log" 2>&1; "gate_$name")
  status=$?
  set -e
  [ "$(tree_digest)" = "$tree" ] || { echo "dev: files changed while $name ran" >&2; status=1; }
  [ $status -eq 0 ] || tail -n 30 "$log" >&2
  printf '%s\t%s\t%s\t%s\t%s\n' "$name" "$(what_runs "$name")" "${number:--}" \
    "$([ $status -eq 0 ] && echo green || echo RED)" "$((SECONDS - began)) s" >"$place/$name.$([ $status -eq 0 ] && echo row || echo red)"
}

# gate [NAME...]: runs these gates, or all without a name. Succeeds only if all are green.
gate() {
  local name tree gate_done
  [ $# -gt 0 ] || set -- "${all_gates[@]}"
  export SWARMSMITH_WERROR=ON
  for name in "$@"; do
    what_runs "$name" >/dev/null || { echo "dev: no gate '$name'; there are ${all_gates[*]}" >&2; exit 2; }
  done
  for name in "$@"; do packages_for "$name"; done
  mkdir -p build-gate
  tree=$(tree_digest)
  find build-gate -mindepth 1 -maxdepth 1 -type d ! -name "$tree" -exec rm -rf {} +
  mkdir -p "build-gate/$tree"
  for name in "$@"; do
    rm -f "build-gate/$tree/$name.red"
    run_gate "$tree" "$name"
  done
  echo
  printf 'tree %s, commit %s\n' "$tree" "$(git describe --always --dirty)"
  for name in "$@"; do cat "build-gate/$tree/$name".r*; done |
    awk -F '\t' 'BEGIN { printf "%-10s %-56s %-28s %-6s %9s\n", "gate", "what ran", "how many", "result", "time" }
      { printf "%-10s %-56s %-28s %-6s %9s\n", $1, $2, $3, $4, $5; red += $4 != "green" }
      END { exit red > 0 }'
}
