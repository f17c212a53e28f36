#!/usr/bin/env bash
# Makes a wheel of the build, installs it in a virtual environment, and uses it there.
# Usage: check_wheel.sh SOURCE BUILD PYTHON
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
python=$3
"$python" -c "import pip, venv, ensurepip" 2>/dev/null || { echo "skipped: no pip and venv (Debian: python3-pip python3-venv)"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset PYTHONPATH
(cd "$source/tools/python" && "$python" -B -c "
import sys, wheel_backend
print(wheel_backend.build_wheel(sys.argv[1], {'build-dir': sys.argv[2]}))" "$folder" "$build") >"$folder/wheel.log" 2>&1 || { cat "$folder/wheel.log"; exit 1; }
"$python" -m venv --system-site-packages "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --no-index --no-deps "$folder"/voussoir-*.whl
cd "$folder"
env/bin/voussoir --version
env/bin/voussoir vehicles lm71 --quiet >/dev/null
# The module finds the cases and the mesher beside it: a fill is meshed, and no source tree is near.
env/bin/python -c "
import sys, voussoir as vs
assert vs.__file__.startswith(sys.prefix), vs.__file__
assert 'lm71' in vs.vehicles()
case = vs.Case(sys.prefix + '/share/voussoir/cases/tutorials/settlement/case.toml')
assert len(case.assembly().fill_tets) > 0
print('The wheel works in', sys.version.split()[0])"
# For another Python the message says so.
mv env/lib/python3*/site-packages/voussoir/_voussoir.cpython-*.so "$(echo env/lib/python3*/site-packages/voussoir)/_voussoir.cpython-27-x86_64-linux-gnu.so"
said=$(env/bin/python -c "import voussoir" 2>&1) && { echo "a module of another Python was imported"; exit 1; }
[[ $said == *"compiled for another Python"* ]] || { echo "$said"; exit 1; }
