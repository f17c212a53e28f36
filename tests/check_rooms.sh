#!/usr/bin/env bash
# A room includes only rooms up-river of it, and none in a circle; VTK stays in io/vtk and viz, OpenMP in solver/base,
# Gmsh, CGAL and cairo in one file each. No type
# has the name of another.
# Usage: check_rooms.sh SOURCE_DIR
set -u
cd "$1" || exit 2
bad=0
# forbid FOLDERS PATTERN WHY: no file in FOLDERS may include what PATTERN matches.
forbid() {
  local hits
  hits=$(grep -rnE "^#include [<\"]($2)" $1 --include='*.h' --include='*.cpp') || return 0
  printf '%s:\n%s\n' "$3" "$hits"
  bad=1
}
forbid "solver/base" "geometry/|solver/[^b]|io/|viz/|tools/" "solver/base is the spring: it includes no other room"
forbid "geometry" "solver/[^b]|io/|viz/|tools/" "geometry is up-river of solver, io, viz and tools"
forbid "solver" "io/|viz/|tools/" "solver never includes io, viz or tools"
forbid "io" "viz/|tools/" "io is up-river of viz and tools"
forbid "viz" "tools/" "viz is up-river of tools"
forbid "tools/ladder" "viz/|io/vtk/|tools/(voussoir|bench)/" "tools/ladder is up-river of the programs and knows no pictures"
forbid "tools/run tools/modal tools/diagnosis tools/hide tools/campaign tools/fragility tools/rate" "tools/(voussoir|bench|blind|convergence|ladder)/" "what verbs report is up-river of the programs"
forbid "geometry solver io viz tools" "tests/" "nothing but tests includes tests"
forbid "geometry solver io/toml io/case io/hdf5 io/info io/msh io/records io/measured io/traffic tools" "vtk" "VTK belongs in io/vtk and viz"
forbid "geometry solver/[!b]* io viz tools" "omp\.h" "OpenMP belongs in solver/base"
if grep -rnE '^#include [<"]gmsh' geometry solver io viz tools --include='*.h' --include='*.cpp' | grep -v '^geometry/gmsh/mesher\.cpp:'; then
  echo "Gmsh belongs in geometry/gmsh/mesher.cpp"; bad=1
fi
if grep -rnE '^#include [<"]cairo' geometry solver io viz tools --include='*.h' --include='*.cpp' | grep -v '^viz/page/cairo_drawing\.cpp:' | grep -v '"viz/'; then
  echo "cairo belongs in viz/page/cairo_drawing.cpp"; bad=1
fi
if grep -rnE '^#include [<"]CGAL' geometry solver io viz tools --include='*.h' --include='*.cpp' | grep -v '^geometry/cgal/cutter\.cpp:'; then
  echo "CGAL belongs in geometry/cgal/cutter.cpp"; bad=1
fi
if grep -rnE '#pragma omp' geometry solver/[!b]* io viz tools --include='*.h' --include='*.cpp'; then
  echo "OpenMP pragmas belong in solver/base"; bad=1
fi
# Rooms that include each other in a circle, in whatever number of steps.
circles=$(grep -rnoE '^#include "(geometry|solver|io|viz|tools)/[^"]+"' geometry solver io viz tools --include='*.h' --include='*.cpp' |
  awk -F'[:"]' 'function room(path, part) { n = split(path, part, "/"); return part[1] == "geometry" || n == 2 ? part[1] : part[1] "/" part[2] }
    room($1) != room($4) { print room($1), room($4) }' | sort -u | tsort 2>&1 >/dev/null)
if [ -n "$circles" ]; then
  printf 'Rooms include each other in a circle:\n%s\n' "$circles"; bad=1
fi
# Two types of one name in one namespace: the linker would take the destructor of one for both.
twice=$(find geometry solver io viz tools -name '*.h' -exec awk '
  FNR == 1 { space = "" }
  /^namespace [a-z_:]+ \{/ { space = $2 }
  /^(struct|class) [A-Za-z0-9]+[^;]*$/ { name = $2 ~ /^alignas/ ? $3 : $2; sub(/[:{].*/, "", name); print space "::" name }' {} + | sort | uniq -d)
if [ -n "$twice" ]; then
  printf 'Types that stand in more than one header:\n%s\n' "$twice"; bad=1
fi
exit $bad
