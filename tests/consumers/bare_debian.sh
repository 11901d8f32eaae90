#!/bin/sh
# bare_debian.sh PACKAGE_FOLDER: checks on a bare Debian 12, as root, that the packages bring everything that the
# command and other programs need. ./dev bare calls it.
set -eu
packages=$(realpath "$1")
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
export DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes
install() { apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends "$@" >/dev/null; }
apt-get update -qq
install "$packages"/octoblisk_*.deb
"$here/use_command.sh" octoblisk "$work"

install "$packages"/liboctoblisk-dev_*.deb g++ pkg-config
cd "$work"
# The flags must be split into words.
# shellcheck disable=SC2046
g++ -std=c++20 "$here/core_example.cpp" -o core_example $(pkg-config --cflags --libs octoblisk-core)
./core_example
cat >plugin.cpp <<'TEXT'
#include <btBulletDynamicsCommon.h>
#include <octoblisk_bullet/register.h>
int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  octoblisk::registerAlgorithm(&dispatcher);
}
TEXT
for package in octoblisk-bullet octoblisk-bullet-float64; do
  # shellcheck disable=SC2046
  g++ -std=c++20 plugin.cpp -o plugin $(pkg-config --cflags --libs "$package")
  ./plugin
done
echo "the packages work on a bare Debian $(cat /etc/debian_version)"
