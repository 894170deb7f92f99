# shellcheck shell=bash disable=SC2154
# The gates of `./dev gate`: all that a commit can be put through, each on its own. Read in by ./dev,
# whose functions it uses. A gate is a function; it ends with a number for the table, written to file
# descriptor 3. In build-gate it leaves NAME.log, and NAME.row, its line of the table. What is green
# is in the ledger, and is not run again.
. tests/gates/ledger.sh

all_gates=(format tidy test long debug clang asan tsan fuzz debian13)

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
    fuzz) echo "fuzz targets, ${SWARMSMITH_FUZZ_SECONDS:-600} s of processor each" ;;
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

# The digest of all files but the ledger; none while something is in no commit.
tree_digest() {
  [ -n "$(git status --porcelain -- . ":!$ledger")" ] ||
    git ls-files -s -- . ":!$ledger" | sha256sum | cut -c 1-16
}

# Each version writes some lines in another way.
format_version=14
is_our_format() { [[ $(clang-format --version) == *" version $format_version."* ]]; }

gate_format() {
  tsc -p web
  is_our_format || { echo "types alone: the format is that of clang-format $format_version" >&3; return 0; }
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
  git ls-files '*.h' '*.cpp' | wc -l | sed 's/$/ files/' >&3
}

# The units of the asan build but the tests', each on its own.
gate_tidy() {
  local units
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target swarmsmith_pb
  units=$(python3 tests/gates/digests.py units)
  cut -d' ' -f1 <<<"$units" | keep_units tidy
  cut -d' ' -f2 <<<"$units" | xargs -P "$jobs" -n 1 tests/gates/tidy_one
  echo "$(wc -l <<<"$units") units" >&3
}

# Tests wait for processes and clocks half of their time: twice as many as there are cores.
test_jobs() { echo $((2 * jobs)); }

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

# tests_gate GATE FOLDER [CTEST-ARGUMENT...]: those that are not green yet, a dozen at a time, after their programs are
# built: what has ended is in the ledger. No test is, if a sanitizer reports anything: reports of every process that they
# start, also of those that are killed, go to files.
tests_gate() {
  local gate=$1 folder=$2 reports=$PWD/build-gate/$1-reports status=0 tree lines open=() programs=()
  local digest program name seconds begin green
  local -A digests
  shift 2
  tree=$(tree_digest)
  lines=$(python3 tests/gates/digests.py tests "$folder" "${tree:-changed}" "$@")
  while read -r digest program name; do
    digests[$name]=$digest
    is_green "$gate" "$name" "$digest" && continue
    open+=("$name")
    [ "$program" = - ] || programs+=("bin/$program")
  done <<<"$lines"
  for name in "${!digests[@]}"; do printf '%s\t%s\n' "$name" "${digests[$name]}"; done | keep_units "$gate"
  [ ${#programs[@]} -eq 0 ] || printf '%s\n' "${programs[@]}" | sort -u | xargs cmake --build "$folder" -j "$jobs" --target
  green=$((${#digests[@]} - ${#open[@]}))
  for ((begin = 0; begin < ${#open[@]}; begin += 12)); do
    rm -rf "$reports"
    mkdir -p "$reports"
    ASAN_OPTIONS=log_path=$reports/report UBSAN_OPTIONS=print_stacktrace=1:log_path=$reports/report \
      TSAN_OPTIONS=log_path=$reports/report:suppressions=$PWD/tests/thread_sanitizer.supp \
      SWARMSMITH_SANITIZER=$gate ctest_gate "$folder" -R "^($(
        printf '%s\n' "${open[@]:begin:12}" | sed 's/[^[:alnum:]_]/\\&/g' | paste -sd '|'))\$" 3>/dev/null || status=$?
    if [ -n "$(ls "$reports")" ]; then
      find "$reports" -type f -exec cat {} + | sed -n 1,400p  # head would end find, and the gate with it
      status=1
      continue
    fi
    [ "$(tree_digest)" = "$tree" ] || tree=  # edited meanwhile
    while IFS=$'\t' read -r name seconds; do
      green=$((green + 1))
      [ -z "$tree" ] || note_green "$gate" "$name" "${digests[$name]}" "test" "$seconds"
    done < <({ tr '\n\t' '  ' <build-gate/tests.xml; echo; } | sed 's/<testcase/\n&/g' |
      sed -n 's/^<testcase name="\([^"]*\)".* time="\([0-9.]*\)" status="run".*/\1\t\2/p' |
      sed 's/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&amp;/\&/g')
  done
  echo "$green of ${#digests[@]} tests" >&3
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
  [ -n "$(missing_of "${aarch64_packages[@]}")" ] || build_aarch64
  SWARMSMITH_LONG=1 tests_gate long build -L 'long|wide'
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

# What scripts need is built, and of the test programs those that are not green yet: all of them take most of an hour.
sanitizer_gate() {
  configure "build-$1" --preset "$1"
  ninja -C "build-$1" -t targets all | sed -n '/_test:\|\/fuzz_/d; s/^\(bin\/[^:]*\):.*/\1/p' |
    xargs cmake --build "build-$1" -j "$jobs" --target
  tests_gate "$1" "build-$1" -LE long
}
gate_asan() { sanitizer_gate asan; }
gate_tsan() { sanitizer_gate tsan; }

# Each target from its seeds and what earlier runs have found worth keeping.
gate_fuzz() {
  local seconds=${SWARMSMITH_FUZZ_SECONDS:-600} lines program digest name seeds open=()
  local -A digests
  configure build-asan --preset asan
  cmake --build build-asan -j "$jobs" --target swarmsmith_pb
  mkdir -p build-fuzz/found
  lines=$(sed 's/^\([^ ]*\).*/fuzz_\1/' build-asan/fuzzers.txt | xargs python3 tests/gates/digests.py programs)
  while read -r program digest; do digests[${program#fuzz_}]=$digest; done <<<"$lines"
  for name in "${!digests[@]}"; do printf '%s\t%s\n' "$name" "${digests[$name]}"; done | keep_units fuzz
  while read -r name seeds; do
    is_green fuzz "$name" "${digests[$name]}" "$seconds" || open+=("$name ${digests[$name]} $seeds")
  done <build-asan/fuzzers.txt
  echo "$(wc -l <build-asan/fuzzers.txt) targets" >&3
  [ ${#open[@]} -gt 0 ] || return 0
  printf 'fuzz_%s\n' "${open[@]%% *}" | xargs cmake --build build-asan -j "$jobs" --target
  printf '%s\n' "${open[@]}" | xargs -P 2 -L 1 tests/fuzz/run_one "$seconds"
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

# Whether all of a gate has one line in the ledger; the others have one for each unit, target or test.
is_one_line() { [[ " format test debug clang debian13 " == *" $1 "* ]]; }

# run_gate NAME. Called alone, not as a condition: its subshell ends at the first command that fails.
run_gate() {
  local row=build-gate/$1.row log=build-gate/$1.log tree began=$SECONDS status=0 number
  tree=$(tree_digest)
  if is_one_line "$1" && [ -n "$tree" ] && is_green "$1" all "$tree"; then
    say "$1: green already"
    number=$(awk -F '\t' -v gate="$1" '$1 == gate && $2 == "all" { print $4 }' "$ledger")
  else
    say "$1: $(what_runs "$1"); see $log"
    set +e
    number=$(set -e; exec 3>&1 >"$log" 2>&1; "gate_$1")
    status=$?
    set -e
    if [ $status -ne 0 ]; then
      tail -n 30 "$log" >&2
    elif is_one_line "$1" && [ -n "$tree" ] && [ "$(tree_digest)" = "$tree" ]; then
      note_green "$1" all "$tree" "$number" $((SECONDS - began))
    fi
  fi
  printf '%s\t%s\t%s\t%s\t%s\n' "$1" "$(what_runs "$1")" "${number:--}" \
    "$([ $status -eq 0 ] && echo green || echo RED)" "$((SECONDS - began)) s" >"$row"
}

# gate [NAME...]: all of them without a name. Says yes only when all are green.
gate() {
  local name
  [ $# -gt 0 ] || set -- "${all_gates[@]}"
  export SWARMSMITH_WERROR=ON
  for name in "$@"; do
    what_runs "$name" >/dev/null || { echo "dev: no gate '$name'; there are ${all_gates[*]}" >&2; exit 2; }
  done
  mkdir -p build-gate/tidy
  for name in "$@"; do packages_for "$name"; done
  for name in "$@"; do run_gate "$name"; done
  echo
  for name in "$@"; do
    cat "build-gate/$name.row"
    [ "$name" != fuzz ] || awk -F '\t' '$1 == "fuzz" { print "fuzz " $2 "\t\t" $4 "\tgreen\t" $5 " s" }' "$ledger"
  done | awk -F '\t' 'BEGIN { printf "%-24s %-46s %-44s %-6s %9s\n", "gate", "what ran", "how many", "result", "time" }
    { printf "%-24s %-46s %-44s %-6s %9s\n", $1, $2, $3, $4, $5; red += $4 != "green" }
    END { exit red > 0 }'
}
