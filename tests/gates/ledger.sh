# shellcheck shell=bash
# The ledger of what is green: tests/gates/green.tsv, a line for each gate and unit. Read in by the scripts of gates.
#   gate, unit, digest of what was tried, what ran, seconds, commit, date
# Seconds are of the processor for tidy and fuzz, of the clock for all others.
# A line counts for what has its digest, in any clone; a later one for the same unit takes its place.

ledger=tests/gates/green.tsv

# is_green GATE UNIT DIGEST [SECONDS]: was it green, and tried for so many seconds of processor?
is_green() {
  awk -F '\t' -v gate="$1" -v unit="$2" -v digest="$3" -v least="${4:-0}" \
    '$1 == gate && $2 == unit && $3 == digest && $5 >= least { found = 1 } END { exit !found }' $ledger
}

# note_green GATE UNIT DIGEST WHAT SECONDS
note_green() {
  local commit
  commit=$(git rev-parse --short=8 HEAD)
  [ -z "$(git status --porcelain -- . ":!$ledger")" ] || commit+=+  # and changes that are in no commit
  (
    flock 9
    { awk -F '\t' -v gate="$1" -v unit="$2" '!($1 == gate && $2 == unit)' $ledger
      printf '%s\t%s\t%s\t%s\t%.0f\t%s\t%s\n' "$@" "$commit" "$(date -u +%F)"; } | LC_ALL=C sort >build-gate/green.tsv
    cat build-gate/green.tsv >$ledger
  ) 9>build-gate/ledger.lock
}

# keep_units GATE: of its lines, only those of units that standard input names, with the digest that may stand beside,
# after a tab. Names may have blanks. Without a name nothing changes: who made the names has failed.
keep_units() {
  local units
  units=$(cat)
  [ -n "$units" ] || { echo "no units of $1: the ledger stays as it is" >&2; return 1; }
  awk -F '\t' -v gate="$1" 'NR == FNR { digest[$1] = $2; next }
    $1 != gate || $2 in digest && (digest[$2] == "" || digest[$2] == $3)' - $ledger <<<"$units" >build-gate/green.tsv
  cat build-gate/green.tsv >$ledger
}

# processor_seconds FILE COMMAND...: runs it; FILE gets the seconds of processor that it took.
processor_seconds() {
  local TIMEFORMAT='%U %S' status=0 file=$1
  shift
  { time "$@" 2>&3 3>&-; } 3>&2 2>"$file" || status=$?
  awk '{ print $1 + $2 }' "$file" >"$file.sum" && mv "$file.sum" "$file"
  return $status
}
