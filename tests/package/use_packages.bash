#!/usr/bin/env bash
# Run by scripts/package-check in a bare Debian, in a folder with the packages, the wheel, a drive,
# use_module.py and the consumers of tests/install.
set -euo pipefail

install() {
  apt-get install --quiet=2 --yes --option Dpkg::Use-Pty=0 "$@" >install.log 2>&1 ||
    { tail -n 20 install.log; exit 1; }
}

failures=0
# check WHAT COMMAND...: says whether the command succeeds
check() {
  local what="$1"
  shift
  if "$@" >output.log 2>&1; then
    echo "ok      $what"
  else
    echo "FAILED  $what: $*"
    cat output.log
    failures=$((failures + 1))
  fi
}

apt-get update --quiet=2

# The wheel comes first, so that it finds only what its own description asks for.
install --no-install-recommends python3-venv
wheel="$(echo gearlash-*.whl)"
python3 -m zipfile --extract "$wheel" wheel
description="$(echo wheel/gearlash-*.dist-info/METADATA)"
check 'the wheel has types' test -f wheel/gearlash/py.typed -a -f wheel/gearlash/_core.pyi
python3 -m venv alone
check 'the wheel installs without a network' alone/bin/pip install --no-index --no-deps "$wheel"
read -ra needed < <(sed -n 's/^ *apt-get install //p' "$description")
install --no-install-recommends "${needed[@]}"
alone/bin/python -c 'import gearlash' 2>alone.log || true
check 'without NumPy it says so' grep "No module named 'numpy'" alone.log
python3 -m venv --system-site-packages environment
check 'the wheel installs beside NumPy' environment/bin/pip install --no-index "$wheel"
check 'pip finds nothing missing' environment/bin/pip check
check 'the module of the wheel' environment/bin/python use_module.py elinco-fd162.toml wheel.json
version="$(environment/bin/python -c 'import gearlash; print(gearlash.__version__)' || true)"
check 'its version is that of its description' grep --line-regexp "Version: $version" "$description"
check 'it leaves' environment/bin/pip uninstall --yes gearlash

install ./gearlash_*.deb
version="$(dpkg-query --show --showformat='${Version}' gearlash)"
examples=/usr/share/doc/gearlash/examples
check "gearlash --version is $version" test "$(gearlash --version)" = "gearlash $version"
gearlash limit-cycle --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3 >cycle.txt
check 'the amplitude of a limit cycle is 0.2416 rad' grep -E 'amplitude, load +±0\.2416[0-9]* rad' cycle.txt
check 'a data sheet' gearlash limit-cycle "$examples/elinco-fd162.toml" --plot phase=cycle.svg
check 'its picture' grep '</svg>' cycle.svg
check 'a page for the browser' gearlash explore "$examples/elinco-fd162.toml" --output servo.html
check 'it has the drive' grep 'id="user-drive">{"toml"' servo.html
check 'a sweep into NetCDF' gearlash sweep "$examples/sweep.toml" --output sweep.nc

# shellcheck source=/dev/null
source /usr/share/bash-completion/completions/gearlash
COMP_WORDS=(gearlash '') COMP_CWORD=1
_gearlash
check 'completion for bash' grep --word-regexp limit-cycle <<<"${COMPREPLY[*]}"
check 'completion for zsh' grep '^#compdef gearlash' /usr/share/zsh/vendor-completions/_gearlash
check 'man page gearlash(1)' gzip --test /usr/share/man/man1/gearlash.1.gz
for verb in "${COMPREPLY[@]}"; do
  [[ $verb == -* ]] ||
    check "man page gearlash-$verb(1)" gzip --test "/usr/share/man/man1/gearlash-$verb.1.gz"
done

install --no-install-recommends ./libgearlash-dev_*.deb cmake g++ make pkgconf
compile() {
  # shellcheck disable=SC2046,SC2317  # several words; called by check
  g++ -std=c++20 "consumer/$1.cpp" -o "$1.out" $(pkg-config --cflags --libs "$2")
}
check 'a program by pkg-config gearlash' compile consumer gearlash
check 'it runs' ./consumer.out
check 'a program by pkg-config gearlash-files' compile file_consumer gearlash-files
check 'it runs' ./file_consumer.out "$examples/elinco-fd162.toml"
check 'CMake finds the library' cmake -S consumer -B build -D GEARLASH_COMPONENTS_ASKED=files
check 'programs by CMake' cmake --build build --target consumer file_consumer
check 'one of them runs' build/consumer

gearlash limit-cycle elinco-fd162.toml --format json >tool.json
check "the wheel's answer is the tool's" python3 use_module.py --same wheel.json tool.json
install --no-install-recommends ./python3-gearlash_*.deb
check 'python3-gearlash compiles its bytecode' test -d /usr/lib/python3/dist-packages/gearlash/__pycache__
check "python3-gearlash is $version" \
  test "$(python3 -c 'import gearlash; print(gearlash.__version__)')" = "$version"
check 'its module' python3 use_module.py elinco-fd162.toml module.json
check "its answer is the tool's" python3 use_module.py --same module.json tool.json
check 'it recommends Matplotlib and xarray' test "$(dpkg-query --show --showformat='${Recommends}' \
  python3-gearlash)" = 'python3-matplotlib, python3-xarray'
install --no-install-recommends python3-matplotlib python3-xarray
check 'pictures and datasets' python3 use_module.py --recommended elinco-fd162.toml

apt-get purge --quiet=2 --yes gearlash libgearlash-dev python3-gearlash >purge.log 2>&1
check 'nothing is left of removed packages' \
  test -z "$(find /etc /usr /var -name '*gearlash*' -not -path '/var/cache/apt/*')"
exit $((failures > 0))
