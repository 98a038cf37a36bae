#!/bin/sh
# The golden hashes as an aarch64 computes them, on any Debian machine, by qemu. As root, for debootstrap:
#   tests/runs/paper/golden_aarch64.sh FOLDER [MIRROR]      an empty folder for Debian, wheels and code
# Wants the packages qemu-user-static and debootstrap, and .venv, whose pip and requirements.lock it uses.
set -eu
folder=$(mkdir -p "$1" && cd "$1" && pwd)
project=$(cd "$(dirname "$0")/../.." && pwd)
root=$folder/root site=$folder/site

# Python of Debian 12, unpacked and not installed: nothing of it runs but the interpreter.
if [ ! -e "$root" ]; then
  debootstrap --arch=arm64 --foreign --variant=minbase --include=python3.11,libstdc++6,gcc \
    bookworm "$root" ${2:-}
  for package in "$root"/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" "$root"; done
fi

# What the library imports, in the versions of requirements.lock.
if [ ! -e "$site" ]; then
  packages="llvmlite mcap lz4 zstandard msgspec numba pandas pyarrow python-dateutil six tzdata
    pydantic pydantic-core annotated-types typing-extensions typing-inspection tomli-w typer click
    shellingham rich markdown-it-py mdurl pygments"
  {
    for package in $packages; do sed -n "s/^\($package==[^ ]*\).*/\1/p" "$project/requirements.lock"; done
    sed -n "s/^\(\(numpy\|scipy\)==[^ ]*\) ; python_full_version < '3.12'.*/\1/p" \
      "$project/requirements.lock"
  } > "$folder/packages.txt"
  "$project/.venv/bin/python" -m pip download --no-deps --only-binary=:all: --python-version 3.11 \
    --platform manylinux2014_aarch64 --platform manylinux_2_17_aarch64 \
    --platform manylinux_2_27_aarch64 --platform manylinux_2_28_aarch64 \
    --dest "$folder/wheels" --requirement "$folder/packages.txt"
  mkdir -p "$site"
  for wheel in "$folder"/wheels/*.whl; do "$project/.venv/bin/python" -m zipfile -e "$wheel" "$site"; done
  cp -r "$project"/.venv/lib/python3*/site-packages/svsa_lab*.dist-info "$site"
fi

cd "$project"
PYTHONPATH=$project:$site SVSA_CACHE=$folder/cache PYTHONDONTWRITEBYTECODE=1 \
  exec nice qemu-aarch64-static -cpu max -L "$root" "$root/usr/bin/python3.11" -m tests.runs.paper.golden
