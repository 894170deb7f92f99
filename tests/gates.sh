# shellcheck shell=bash disable=SC2154
# The gates of `./dev gate`: all that a commit can be put through, each on its own. Read in by ./dev,
# whose functions it uses. A gate is a function; it ends with a number for the table, written to file
# descriptor 3. In build-gate it leaves NAME.log, and NAME.row, its line of the table. What is green
# for a commit is not run for it again.

all_gates=(format tidy test long debug clang asan tsan fuzz)

what_runs() {
  case $1 in
    format) echo "clang-format; types of the pages" ;;
    tidy) echo "clang-tidy, without tests" ;;
    test) echo "tests, release build" ;;
    long) echo "long tests, release build" ;;
    debug) echo "hashes of trajectories, not optimised" ;;
    clang) echo "hashes of trajectories, clang" ;;
    asan) echo "tests, AddressSanitizer and UBSan" ;;
    tsan) echo "tests, ThreadSanitizer" ;;
    fuzz) echo "fuzz targets, ${SWARMSMITH_FUZZ_SECONDS:-600} s each" ;;
    *) return 1 ;;
  esac
}

packages_for() {
  case $1 in
    format) install_missing "${lint_packages[@]}" ;;
    test | tsan) install_test_packages ;;
    long) install_test_packages; install_for_tests "${r_packages[@]}" "${snippet_packages[@]}" ;;
    asan) install_test_packages; install_missing "${lint_packages[@]}" ;;
    *) install_missing "${build_packages[@]}" "${test_packages[@]}" "${lint_packages[@]}" ;;
  esac
}

# The commit, when nothing has been changed since; what its gates find can be remembered.
clean_commit() {
  [ -n "$(git status --porcelain)" ] || git rev-parse HEAD
}

gate_format() {
  tsc -p web
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
  git ls-files '*.h' '*.cpp' | wc -l | sed 's/$/ files/' >&3
}

# The units of the asan build, as they stand beside the same headers: one that has passed is not
# looked at again, in any commit.
gate_tidy() {
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target swarmsmith_pb
  mkdir -p build-gate/tidy
  local units headers
  headers=$(git ls-files '*.h' '*.proto' .clang-tidy | xargs cat | sha1sum)
  mapfile -t units < <(sed -n 's/^  "file": "\(.*\)",*$/\1/p' build-asan/compile_commands.json |
    grep -v -e _verify_interface_ -e "^$PWD/tests/" -e /build-asan/tests/ -e /generated/ | sort -u)
  printf '%s\n' "${units[@]}" | xargs -P "$jobs" -n 1 tests/tidy_one "$headers"
  echo "${#units[@]} units" >&3
}

# Tests wait for processes much of their time: half as many again as there are cores.
test_jobs() { echo $((jobs + (jobs + 1) / 2)); }

# ctest_gate FOLDER [CTEST-ARGUMENT...]
ctest_gate() {
  local folder=$1 status=0
  shift
  ctest --test-dir "$folder" --output-on-failure -j "$(test_jobs)" --output-junit "$PWD/build-gate/tests.xml" "$@" ||
    status=$?
  tr '\n\t' '  ' <build-gate/tests.xml | sed -n \
    's/.* tests="\([0-9]*\)" *failures="\([0-9]*\)" *disabled="[0-9]*" *skipped="\([0-9]*\)".*/\1 tests, \2 failed, \3 skipped/p' >&3
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
  ctest_gate build -LE long
}

gate_long() {
  build_all
  SWARMSMITH_LONG=1 ctest_gate build -L 'long|cluster'
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

# Reports of every process that the tests start, also of those that are killed, go to files: one is
# enough to fail.
sanitizer_gate() {
  local reports=$PWD/build-gate/$1-reports status=0
  rm -rf "$reports"
  mkdir -p "$reports"
  configure "build-$1" --preset "$1"
  cmake --build "build-$1" -j "$jobs"
  ASAN_OPTIONS=log_path=$reports/report UBSAN_OPTIONS=print_stacktrace=1:log_path=$reports/report \
    TSAN_OPTIONS=log_path=$reports/report:suppressions=$PWD/tests/thread_sanitizer.supp \
    SWARMSMITH_SANITIZER=$1 ctest_gate "build-$1" -LE 'long|slow' || status=$?
  find "$reports" -type f -exec cat {} + | head -n 400
  [ -z "$(ls "$reports")" ] && return "$status"
}
gate_asan() { sanitizer_gate asan; }
gate_tsan() { sanitizer_gate tsan; }

# Each target from its seeds and what earlier runs have found worth keeping; a row of the table each.
# One that is the same program as in another commit, and was green there, is not run again.
gate_fuzz() {
  local row
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target fuzzers
  mkdir -p build-fuzz/found
  for row in build-gate/fuzz-*.row; do  # of targets that are there no more
    [[ " $(cut -d' ' -f1 build-asan/fuzzers.txt | tr '\n' ' ')" == *" $(basename "${row#*fuzz-}" .row) "* ]] || rm -f "$row"
  done
  echo "$(wc -l <build-asan/fuzzers.txt) targets" >&3
  xargs -P 2 -L 1 tests/fuzz/run_one "${SWARMSMITH_FUZZ_SECONDS:-600}" <build-asan/fuzzers.txt
}

# run_gate NAME. Called alone, not as a condition: its subshell ends at the first command that fails.
run_gate() {
  local row=build-gate/$1.row log=build-gate/$1.log commit began=$SECONDS status number
  commit=$(clean_commit)
  if [ -n "$commit" ] && grep -qs "^$commit	$1	$(what_runs "$1")	.*	green	" "$row"; then
    say "$1: green already at this commit"
    return 0
  fi
  say "$1: $(what_runs "$1"); see $log"
  set +e
  number=$(set -e; exec 3>&1 >"$log" 2>&1; "gate_$1")
  status=$?
  set -e
  [ "$(clean_commit)" = "$commit" ] || commit=  # edited meanwhile
  printf '%s\t%s\t%s\t%s\t%s\t%s\n' "${commit:-changed}" "$1" "$(what_runs "$1")" "${number:--}" \
    "$([ $status -eq 0 ] && echo green || echo RED)" "$((SECONDS - began)) s" >"$row"
  [ $status -eq 0 ] || tail -n 30 "$log" >&2
}

# gate [NAME...]: all of them without a name. Says yes only when all are green.
gate() {
  local name rows=()
  shopt -s nullglob
  [ $# -gt 0 ] || set -- "${all_gates[@]}"
  for name in "$@"; do
    what_runs "$name" >/dev/null || { echo "dev: no gate '$name'; there are ${all_gates[*]}" >&2; exit 2; }
  done
  mkdir -p build-gate
  for name in "$@"; do packages_for "$name"; done
  for name in "$@"; do
    run_gate "$name"
    rows+=("build-gate/$name.row")
    [ "$name" != fuzz ] || rows+=(build-gate/fuzz-*.row)
  done
  echo
  awk -F '\t' 'BEGIN { printf "%-20s %-38s %-34s %-6s %9s\n", "gate", "what ran", "how many", "result", "time" }
    { printf "%-20s %-38s %-34s %-6s %9s\n", $2, $3, $4, $5, $6; red += $5 != "green" }
    END { exit red > 0 }' "${rows[@]}"
}
