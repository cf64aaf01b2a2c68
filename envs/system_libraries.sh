#!/bin/sh
# Make sure that gmsh imports and that VTK renders off screen; on Debian and Ubuntu install what their wheels need.
# Usage: system_libraries.sh PYTHON
set -u
python=$1
packages="libglu1-mesa libgl1 libxrender1 libxcursor1 libxft2 libxinerama1 libgomp1 libosmesa6"
install="apt-get install -y --no-install-recommends $packages"

works() {
    "$python" -c 'import gmsh' >/dev/null 2>&1 &&
        "$python" -m r37core.figures.offscreen >/dev/null 2>&1
}

works && exit 0

if command -v apt-get >/dev/null 2>&1; then
    if [ "$(id -u)" = 0 ]; then
        sudo=
    elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
        sudo=sudo
    else
        echo "gmsh and VTK need system libraries that are missing, and this user may not install them. Run:" >&2
        echo "    sudo apt-get update && sudo $install" >&2
        exit 1
    fi
    echo "installing the system libraries that gmsh and VTK need: $packages"
    $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo $install -qq >/dev/null
    works && exit 0
fi

echo "gmsh or VTK does not work on this machine; their wheels need the equivalents of these Debian packages:" >&2
echo "    $packages" >&2
"$python" -c 'import gmsh' >&2
"$python" -m r37core.figures.offscreen >&2
exit 1
