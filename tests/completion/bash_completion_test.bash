#!/usr/bin/env bash
# bash_completion_test.bash COMPLETIONS GEARLASH: what bash offers, of completions made now, for
# GEARLASH and for a tool with every kind of option.
set -uo pipefail  # not -e, as in the shell of a user: compgen fails where it has nothing to offer

here="$(dirname "$(realpath "$0")")"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
mkdir drives
touch servo.toml notes.txt drives/axis.toml "spare servo.toml"

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

# shellcheck source=/dev/null
source <("$1" bash "$2")
expect 'limit-cycle' li
expect '--format' limit-cycle --fo
expect 'drives servo.toml spare servo.toml' limit-cycle ''

# shellcheck source=/dev/null
source <("$1" bash "$here/tool_with_all_kinds")
expect '--help -h draw look old' ''
expect 'look' look
expect '--a-flag-of-the-column-full --damping --format --help --shaft -h' look -
expect 'drives servo.toml spare servo.toml' look ''
expect 'drives/axis.toml' look drives/
expect 'servo.toml' look --a-flag-of-the-column-full se
expect 'servo.toml' look --damping 0.1 se
expect '' look --damping ''
expect 'json text' look --format ''
expect 'json' look --format = j
expect 'both load motor' look --shaft ''
expect 'phase= time=' draw --plot ''
expect 'time=' draw --plot = t
expect 'notes.txt' draw --plot time = n
expect 'notes.txt' draw --plot = time = n
expect 'notes.txt' draw --output n
expect 'notes.txt' draw --output = n
expect 'drives' draw --folder ''
expect '--output' draw --plot time = a.svg --o
expect 'run' old r
expect '' old run ''
exit $((failures > 0))
