#!/bin/sh
# Takes the pictures of README.md again, all of them or those that are named:
#
#   docs/pictures/make.sh [NAME...]
set -eu
cd "$(dirname "$0")/../.."
tenon=${TENON:-build/tenon}
wanted=" $* "

# picture NAME SCENE [ARGUMENT...]
picture() {
  name=$1
  scene=$2
  shift 2
  case "$wanted" in
    "  " | *" $name "*) "$tenon" render "scenes/$scene.scad" "$@" -o "docs/pictures/$name.png" ;;
  esac
}

picture lantern lantern --size 640x480 --integrator path --spp 64 --depth 8 --denoise
picture bracket bracket --size 480x360 --spp 16
picture bracket_cut bracket --size 480x360 --spp 16 --cut -y --hatch
picture valve valve --size 640x480 --spp 16
picture valve_cut valve --size 640x480 --spp 16 --cut -y/x --hatch
picture pencils pencils --size 640x480 --spp 16
picture ima1 ima1 --size 640x480 --spp 9
picture ima2 ima2 --size 640x480 --spp 9
picture ima3 ima3 --size 640x480 --spp 4 --depth 5
picture forest forest --size 960x600 --spp 16
picture stone_and_wood stone_and_wood --size 480x360 --integrator path --spp 96 --denoise
picture grooved_sphere grooved_sphere --size 480x360 --spp 9
picture checkered_cube checkered_cube --size 480x360 --spp 9
picture small_shell small_shell --size 480x360 --spp 9
picture large_shell large_shell --size 480x360 --spp 9
for name in barth_sextic heart teapot; do picture "$name" "$name" --size 480x360 --spp 9; done
# The mesh is not ours to ship: ./dev bunny gets it.
if [ -f build/bunny.off ]; then picture bunny_reused bunny/reused --size 640x480 --spp 9; fi
