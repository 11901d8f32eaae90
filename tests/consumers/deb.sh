#!/bin/sh
# deb.sh BUILD_DIR EXAMPLE_DIR OUT_DIR: makes and unpacks the Debian packages of a build. The command finds its
# libraries and runs, and programs compile against the other packages.
set -eu
build_dir=$1 example_dir=$2 out_dir=$3
here=$(dirname "$0")
rm -rf "$out_dir"
mkdir -p "$out_dir"
(cd "$out_dir" && cpack --config "$build_dir/CPackConfig.cmake" -B "$out_dir" >cpack.log) || {
  cat "$out_dir/cpack.log"
  exit 1
}
rm -rf "$out_dir/_CPack_Packages"
for package in "$out_dir"/*.deb; do
  dpkg-deb --field "$package" Package Version Depends
  dpkg-deb --extract "$package" "$out_dir/root"
  documents=$out_dir/root/usr/share/doc/$(dpkg-deb --field "$package" Package)
  zcat "$documents/changelog.gz" | grep -q '^# Changelog'
  version=$(zcat "$documents/changelog.Debian.gz" | dpkg-parsechangelog --file - --show-field Version)
  [ "$version" = "$(dpkg-deb --field "$package" Version)" ]
  for packed in "$documents"/*.gz; do
    [ "$(od -An -tu4 -j4 -N4 "$packed" | tr -d ' ')" = 0 ]  # no time stamp, so the bytes do not depend on the time
  done
done
zcat "$out_dir/root/usr/share/man/man1/octoblisk.1.gz" | grep -q '^\.TH OCTOBLISK 1'

# The command's libraries exist, and come from the packages that it depends on.
command=$out_dir/root/usr/bin/octoblisk
if ldd "$command" | grep 'not found'; then exit 1; fi
dpkg-deb --field "$out_dir"/octoblisk_*.deb Depends | grep -q libembree
"$here/use_command.sh" "$command" "$out_dir"

"$here/installed.sh" "$out_dir/root/usr" "$example_dir" "$out_dir/programs"
