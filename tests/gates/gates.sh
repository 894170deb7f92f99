# shellcheck shell=bash
# The gates of `./dev gate`: all that a tree of files can be put through. Read in by ./dev, whose functions it uses. A gate
# is a function; it ends with a number for the table, written to file descriptor 3. It is green for a tree, or it is not:
# build-gate/TREE has GATE.row, its line of the table, once it is; before that GATE.done, what of it is green already, a
# line for each test, unit or target. Logs are build-gate/GATE.log.

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

fuzz_seconds=${SWARMSMITH_FUZZ_SECONDS:-60}

# The digest of all files, also of those that are in no commit yet.
tree_digest() {
  local index=$PWD/build-gate/index
  cp -p "$(git rev-parse --git-dir)/index" "$index"  # by its time, git knows which files it must read
  GIT_INDEX_FILE=$index git add -A && GIT_INDEX_FILE=$index git write-tree | cut -c 1-16
}

# Each version writes some lines in another way.
format_version=14
is_our_format() { [[ $(clang-format --version) == *" version $format_version."* ]]; }

gate_format() {
  tsc -p web
  python3 tests/gates/plain_words.py
  is_our_format || { echo "types alone: the format is that of clang-format $format_version" >&3; return 0; }
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
  git ls-files '*.h' '*.cpp' | wc -l | sed 's/$/ files/' >&3
}

# The units of the asan build but the tests' and those that protoc writes. The analyser follows 25,000 steps of a
# function's paths (its own default is 225,000): nearly all that need more spend them in the standard library and in fmt,
# and they took two thirds of the time. It takes the files of a unit for headers.
gate_tidy() {
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target swarmsmith_pb
  sed -n 's/^ *"file": "\(.*\)".*/\1/p' build-asan/compile_commands.json | grep -v '/tests/\|\.pb\.cc$' | sort -u >build-gate/units
  { grep -vxFf "$gate_done" build-gate/units || true; } | xargs -r -P "$jobs" -I{} sh -c 'clang-tidy -p build-asan --quiet \
    --checks=-bugprone-suspicious-include --extra-arg=-Xclang --extra-arg=-analyzer-opt-analyze-headers \
    --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=max-nodes=25000 "$1" && echo "$1" >>"$2"' \
    sh {} "$gate_done"
  echo "$(wc -l <build-gate/units) units" >&3
}

# Tests wait for processes and clocks half of their time: twice as many as there are cores.
test_jobs() { echo $((2 * jobs)); }

# tests_gate FOLDER [CTEST-ARGUMENT...]: the tests that are not green yet, by their numbers. Reports of sanitizers go to
# files, also those of processes that are killed; any of them is red, whatever the tests say.
tests_gate() {
  local folder=$1 open reports=${gate_done%.done}-reports status=0
  shift
  open=$(ctest --test-dir "$folder" -N "$@" | sed -n 's/^ *Test *#\([0-9]*\): .*/\1/p' | grep -vxFf "$gate_done" | paste -sd,) || true
  mkdir -p "$reports"
  [ -z "$open" ] || ASAN_OPTIONS=log_path=$reports/report UBSAN_OPTIONS=print_stacktrace=1:log_path=$reports/report \
    TSAN_OPTIONS=log_path=$reports/report:suppressions=$PWD/tests/thread_sanitizer.supp \
    ctest --test-dir "$folder" --output-on-failure -j "$(test_jobs)" -I "0,0,0,$open" | tee >(cat >&2) |
    sed -nu 's/.*Test *#\([0-9]*\): .* \(Passed\|\*\*\*Skipped\) .*/\1/p' >>"$gate_done" || status=$?
  find "$reports" -type f -exec cat {} + | sed -n 1,400p  # head would end find, and the gate with it
  [ -z "$(ls "$reports")" ] || status=1
  echo "$(sort -u "$gate_done" | wc -l) of $(ctest --test-dir "$folder" -N "$@" | sed -n 's/^Total Tests: //p') tests" >&3
  return "$status"
}

# Tests write into memory where there is room: on a disk, they wait for it most of their time. Not the
# long ones. What a run left that was killed goes first: a folder's name has the process.
write_into_memory() {
  local left process
  for left in /dev/shm/swarmsmith-tests.*.*; do
    process=${left#*swarmsmith-tests.}
    [ -O "$left" ] && ! kill -0 "${process%%.*}" 2>/dev/null && rm -rf "$left"
  done
  if [ -w /dev/shm ] && [ "$(df --output=avail -B 1M /dev/shm | tail -n 1)" -ge 4096 ]; then
    TMPDIR=$(mktemp -d "/dev/shm/swarmsmith-tests.$BASHPID.XXXXXX")
    chmod 755 "$TMPDIR"  # some tests become somebody else
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

# The same bits without optimisation, and from another compiler.
hashes_gate() {
  configure "build-$1" --preset "$1"
  cmake --build "build-$1" -j "$jobs" --target sim_engine_test
  "build-$1/bin/sim_engine_test" --gtest_filter='Determinism*' | tee build-gate/hashes
  sed -n 's/^\[  PASSED  \] \([0-9]*\) tests*\..*/\1 tests/p' build-gate/hashes >&3
}
gate_debug() { hashes_gate debug; }
gate_clang() { hashes_gate clang; }

sanitizer_gate() {
  configure "build-$1" --preset "$1"
  ninja -C "build-$1" -t targets all | sed -n '/\/fuzz_/d; s/^\(bin\/[^:]*\):.*/\1/p' |
    xargs cmake --build "build-$1" -j "$jobs" --target
  SWARMSMITH_SANITIZER=$1 tests_gate "build-$1" -LE long
}
gate_asan() { sanitizer_gate asan; }
gate_tsan() { sanitizer_gate tsan; }

# Each target from its seeds and what earlier runs have found worth keeping.
gate_fuzz() {
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target fuzzers
  mkdir -p build-fuzz/found
  { grep -vf <(sed 's/.*/^& /' "$gate_done") build-asan/fuzzers.txt || true; } |
    xargs -r -P 2 -L 1 tests/fuzz/run_one "$fuzz_seconds" "$gate_done"
  echo "$(wc -l <build-asan/fuzzers.txt) targets" >&3
}

# What CI does in a bare Debian 13; then what is compared with R's irace beside the irace 4.2 of that system, and its
# programs beside this system's. The root stays in build-debian13, with its packages and what was built.
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

# run_gate TREE NAME. Called alone, not as a condition: its subshell ends at the first command that fails.
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

# gate [NAME...]: all of them without a name. Says yes only when all are green.
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
