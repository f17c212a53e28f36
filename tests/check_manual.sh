#!/usr/bin/env bash
# The manual pages and the completion that the program writes: a page for each verb with each of its options, without
# warnings of groff and mandoc where these are installed; completions as bash offers them.
# Usage: check_manual.sh PROGRAM
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bad=0
fail() { echo "$*"; bad=1; }

"$program" manual "$folder"
page_of() { echo "$folder/man1/voussoir-${1// /-}.1"; }
verbs=$("$program" --help | sed -nE 's/^  ([a-z]+) .*/\1/p')
parts=$("$program" motion --help | sed -nE 's/^  ([a-z]+) .*/motion \1/p')
[ "$(wc -w <<<"$verbs")" -gt 20 ] && [ "$(wc -l <<<"$parts")" -ge 5 ] || fail "--help names fewer verbs and parts than expected"
while read -r verb; do
  [ -s "$(page_of "$verb")" ] || fail "$verb has no page"
  [ "$verb" = motion ] && continue
  # shellcheck disable=SC2086
  for option in $("$program" $verb --help | grep -oE '(^  |\[ )--[a-z0-9-]+' | grep -oE -- '--[a-z0-9-]+'); do
    grep -qF -- "\\fB${option//-/\\-}\\fR" "$(page_of "$verb")" || fail "the page of $verb lacks $option"
  done
done <<<"$verbs"$'\n'"$parts"
while read -r verb; do
  grep -qF -- "\\fBvoussoir\\-${verb// /\\-}\\fR(1)" "$folder/man1/voussoir.1" || fail "voussoir.1 does not name $verb"
done <<<"$verbs"

if command -v groff >/dev/null; then
  for page in "$folder"/man1/*.1; do
    said=$(groff -man -ww -z -Tutf8 "$page" 2>&1)
    [ -z "$said" ] || fail "groff: $said"
  done
  groff -man -Tutf8 "$(page_of run)" | tr -s '[:space:]' ' ' | sed 's/\x1b\[[0-9;]*m//g; s/.\x08//g' > "$folder/run.txt"
  for words in 'voussoir run CASE [-o DIR] [--until T]' '-o, --output DIR' "(default: the case's name)" '--compression WORD' '(default: lz4)' \
               'voussoir run cases/demo.toml -o demo --threads 2'; do
    grep -qF -- "$words" "$folder/run.txt" || fail "the page of run does not show: $words"
  done
else
  echo "groff is not installed: the pages were not set"
fi
if command -v mandoc >/dev/null; then  # the date is left out, so that a page is the same whenever it is made
  said=$(mandoc -Tlint -Wwarning "$folder"/man1/*.1 | grep -v 'missing date' || true)
  [ -z "$said" ] || fail "mandoc: $said"
fi

# What bash offers for the words typed so far; the last may be empty.
offered() {
  bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _voussoir; for word in "${COMPREPLY[@]}"; do printf "%s " "$word"; done' - "$folder/completions/voussoir" voussoir "$@"
}
expect() {
  local wanted=$1
  shift
  local found
  found=$(cd "$folder" && offered "$@")
  [ "$found" = "$wanted" ] || fail "after '$*' bash offers '$found', not '$wanted'"
}
touch "$folder/my-case.toml"
expect "run resume render report rate " r
expect "--until " run my-case.toml --u
expect "my-case.toml " run my
expect "man1 " run -o ma
expect "" run --threads ""
expect "synthesize " motion sy
expect "--taper " motion process --ta
expect "my-case.toml " motion info my
expect "--version " --ver
for verb in $verbs; do
  expect "$verb $("$program" --help | sed -nE "s/^  ($verb[a-z]+) .*/\1 /p" | tr -d '\n')" "$verb"
done
exit $bad
