#!/bin/sh
# shared.sh SOURCE EXAMPLE_DIR OUT_DIR: builds and installs core and plugin as shared libraries, and programs that use
# them.
set -eu
source=$1 example_dir=$2 out_dir=$3
here=$(dirname "$0")
cmake -S "$source" -B "$out_dir/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
  -DOCTOBLISK_BUILD_DEMOS=OFF -DOCTOBLISK_BUILD_TESTS=OFF >/dev/null
cmake --build "$out_dir/build"
rm -rf "$out_dir/prefix"
cmake --install "$out_dir/build" --prefix "$out_dir/prefix" >/dev/null
"$here/installed.sh" "$out_dir/prefix" "$example_dir" "$out_dir/programs"
# The program links the shared library by a name that contains its version.
readelf -d "$out_dir/programs/yours" | grep -q 'liboctoblisk-bullet\.so\.[0-9]*\.[0-9]*\]'
