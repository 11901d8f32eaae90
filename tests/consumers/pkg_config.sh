#!/bin/sh
# pkg_config.sh PREFIX EXAMPLE_DIR OUT_DIR [PACKAGE...]: compiles and runs a program for each package, by default all,
# with only the flags of its installed .pc file.
set -eu
prefix=$1 example_dir=$2 out_dir=$3
shift 3
[ $# -gt 0 ] || set -- octoblisk-core octoblisk-bullet octoblisk-bullet-float64
here=$(dirname "$0")
mkdir -p "$out_dir"
PKG_CONFIG_PATH=$(find "$prefix" -name pkgconfig -type d)
export PKG_CONFIG_PATH

for package; do
  source=readme_example.cpp
  [ "$package" != octoblisk-core ] || source=core_example.cpp
  flags=$(pkg-config --cflags --libs "$package")
  echo "$package: $flags"
  # The flags are quoted for a shell.
  eval "${CXX:-c++} -std=c++20 -I'$example_dir' '$here/$source' -o '$out_dir/$package' $flags"
  LD_LIBRARY_PATH=${PKG_CONFIG_PATH%/pkgconfig} "$out_dir/$package"
done
