#!/bin/sh
# use_command.sh COMMAND FOLDER: runs a package's octoblisk, which must find that an arm meets itself.
set -eu
command=$1
cd "$2"
"$command" --version
"$command" make arm --out arm.ply
printf 'x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n' >poses.csv
status=0
"$command" check --fixed arm.ply --moving arm.ply --poses poses.csv --out result.csv || status=$?
[ "$status" -eq 1 ]
