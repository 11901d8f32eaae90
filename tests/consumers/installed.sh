#!/bin/sh
# installed.sh PREFIX EXAMPLE_DIR OUT_DIR: builds and runs programs against the installed files, with CMake and
# pkg-config.
set -eu
prefix=$1 example_dir=$2 out_dir=$3
here=$(dirname "$0")
cmake --fresh -S "$here/installed" -B "$out_dir" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DEXAMPLE_DIR="$example_dir" >/dev/null
cmake --build "$out_dir"
ctest --test-dir "$out_dir" --output-on-failure
"$here/pkg_config.sh" "$prefix" "$example_dir" "$out_dir/pkg_config"
