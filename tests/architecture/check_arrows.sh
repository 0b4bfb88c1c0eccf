#!/bin/sh
# Checks that every include follows an arrow of ARCHITECTURE.md: a folder includes only from the folders it may use,
# and programs only from include/tenon/.
set -eu
cd "$(dirname "$0")/../.."

# The folders each folder may include from, besides itself.
allowed() {
  case "$1" in
    base) echo "" ;;
    math) echo "base" ;;
    kdtree) echo "math base" ;;
    primitive) echo "kdtree math base" ;;
    mesh) echo "primitive math base" ;;
    text) echo "plane primitive math base" ;;
    drawing) echo "plane primitive math base" ;;
    plane) echo "primitive math base" ;;
    csg) echo "primitive math base" ;;
    accel) echo "csg primitive kdtree math base" ;;
    scene) echo "accel csg primitive math base" ;;
    film) echo "image math base" ;;
    render) echo "film image scene accel csg primitive math base" ;;
    lang) echo "scene accel csg mesh drawing text plane primitive math base" ;;
    image) echo "math base" ;;
    exchange) echo "render film image scene accel csg primitive math base" ;;
    *) echo "?" ;;
  esac
}

failed=0
for folder in base math kdtree primitive mesh plane text drawing csg accel scene image film render lang exchange; do
  for file in $(find "src/$folder" "include/tenon/$folder" \( -name '*.h' -o -name '*.cpp' \) 2>/dev/null); do
    for used in $(sed -n 's|^#include "\(tenon/\)\{0,1\}\([a-z]*\)/.*|\2|p' "$file" | sort -u); do
      [ "$used" = "$folder" ] && continue
      [ "$used" = tenon ] && continue # include/tenon/version.h belongs to all
      case " $(allowed "$folder") " in
        *" $used "*) ;;
        *)
          echo "$file: error: $folder may not include from $used (ARCHITECTURE.md, the arrows)"
          failed=1
          ;;
      esac
    done
  done
done
for file in $(find apps -name '*.h' -o -name '*.cpp'); do
  if grep -nE '^#include "(base|math|kdtree|primitive|mesh|plane|text|drawing|csg|accel|scene|film|render|lang|image|exchange)/' "$file"; then
    echo "$file: error: programs include only from include/tenon/"
    failed=1
  fi
done
exit $failed
