#!/usr/bin/env bash
# bash_completion_test.bash COMPLETIONS GEARLASH: what bash offers, of a completion made now.
set -euo pipefail

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"$1" bash "$2" >"$folder/gearlash"
# shellcheck source=/dev/null
source "$folder/gearlash"
cd "$folder"
mkdir drives
touch servo.toml notes.txt drives/axis.toml "spare servo.toml"

set +e  # as in the shell of a user: compgen fails where it has nothing to offer
failures=0
# expect OFFERED WORD...: what is offered, in order, when <TAB> follows the last WORD
expect() {
  local expected="$1" offered
  shift
  COMP_WORDS=(gearlash "$@") COMP_CWORD=$# COMPREPLY=()
  _gearlash
  offered="$(printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' ')"
  if [[ $offered != "$expected" ]]; then
    echo "gearlash $*<TAB> offers: $offered; should offer: $expected" >&2
    failures=$((failures + 1))
  fi
}

expect 'limit-cycle' li
expect 'limit-cycle' limit-cycle
expect '--format' limit-cycle --fo
expect 'json text' limit-cycle --format ''
expect 'json' limit-cycle --format = j
expect 'drives servo.toml spare servo.toml' limit-cycle ''
expect 'drives/axis.toml' limit-cycle drives/
expect 'servo.toml' limit-cycle --damping 0.1 se
expect '' limit-cycle --damping ''
expect 'notes.txt' chart --output n
expect 'notes.txt' chart --output = n
expect 'phase= time=' simulate --plot ''
expect 'time=' simulate --plot = t
expect 'notes.txt' simulate --plot time = n
expect 'notes.txt' simulate --plot = time = n
expect '--output' thesis figure --o
expect 'figure' thesis f
exit $((failures > 0))
