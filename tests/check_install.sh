#!/usr/bin/env bash
# Installs the build, moves the prefix elsewhere, and builds and runs a program of somebody else's with it.
# Usage: check_install.sh SOURCE BUILD
set -euo pipefail
source=$(realpath "$1")
build=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/there" --strip >"$folder/install.log"
mv "$folder/there" "$folder/here"
cd "$folder"
here/bin/voussoir --version
# What the program reads is found beside it, not in the source tree.
here/bin/voussoir vehicles lm71 --quiet >vehicle.txt
here/bin/voussoir generate here/share/voussoir/cases/tutorials/settlement/case.toml -o fill.h5 --quiet
for file in share/man/man1/voussoir.1.gz share/man/man1/voussoir-motion-info.1.gz share/bash-completion/completions/voussoir; do
  [ -s "here/$file" ] || { echo "$file is not installed"; exit 1; }
done
if grep -rlF --exclude="*.a" -e "$source" -e "$folder/there" here; then echo "These files name the folder of the sources or the prefix."; exit 1; fi
cmake -S "$source/docs/example-project" -B example -DCMAKE_PREFIX_PATH="$folder/here" -DCMAKE_BUILD_TYPE=Release >example.log || { cat example.log; exit 1; }
cmake --build example
said=$(example/one-block)
echo "$said"
# The weight of half a metre of stone over the stiffness of the joint: 2000 · 9.81 · 0.5 / 1e9 = 9.81e-6 m.
[[ $said == "After 1 s the block has sunk by 9.81e-06 m"* ]] || { echo "The block should have sunk by 9.81e-06 m."; exit 1; }
