#!/bin/sh
# Checks that who calls gamma() (tenon/math/rounding.h) includes its header: the C library has a function of that name,
# which would be called without a word where ours is not known, and bounds on errors would be wrong.
set -eu
cd "$(dirname "$0")/../.."

failed=0
for file in $(grep -rlE '(^|[^A-Za-z0-9_:.>])gamma\(' --include='*.h' --include='*.cpp' --exclude-dir=node_modules \
  src include apps bench tests); do
  [ "$file" = include/tenon/math/rounding.h ] && continue
  if ! grep -q '^#include "tenon/math/rounding.h"' "$file"; then
    echo "$file: error: it calls gamma(), so it has to include tenon/math/rounding.h: the C library has a gamma() too"
    failed=1
  fi
done
exit $failed
