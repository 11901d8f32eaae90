#!/bin/sh
# bare_debian.sh PACKAGE_FOLDER: on a Debian 12 where nothing else is, as root: the packages bring all that the command
# and programs of others need. ./dev bare calls it.
set -eu
packages=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
export DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes
install() { apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends "$@" >/dev/null; }
apt-get update -qq
install "$packages"/octoblisk_*.deb
cd "$work"
octoblisk --version
octoblisk make arm --out arm.ply
printf 'x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n' >poses.csv
status=0
octoblisk check --fixed arm.ply --moving arm.ply --poses poses.csv --out result.csv || status=$?
[ "$status" -eq 1 ]  # an arm meets itself

install "$packages"/liboctoblisk-dev_*.deb g++ pkg-config
# Words of flags are meant to be split.
# shellcheck disable=SC2046
g++ -std=c++20 "$here/core_example.cpp" -o core_example $(pkg-config --cflags --libs octoblisk-core)
./core_example
printf '#include <octoblisk_bullet/clustered_octree_shape.h>\nint main() {}\n' >plugin.cpp
for package in octoblisk-bullet octoblisk-bullet-float64; do
  # shellcheck disable=SC2046
  g++ -std=c++20 plugin.cpp -o plugin $(pkg-config --cflags --libs "$package")
  ./plugin
done
echo "the packages work on a bare Debian $(cat /etc/debian_version)"
