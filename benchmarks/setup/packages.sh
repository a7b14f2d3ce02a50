# Debian packages of Diptych and how to get them. Sourced by build.sh; defines need_packages.

packages_build="g++ cmake ninja-build pkg-config libeigen3-dev libhdf5-dev libtomlplusplus-dev
  libmuparser-dev libcli11-dev libfmt-dev nlohmann-json3-dev libxxhash-dev libpugixml-dev"
packages_report="libjs-chart.js"
packages_tests="libgtest-dev libgmock-dev libyaml-cpp-dev gmsh"
packages_ranks="libopenmpi-dev openmpi-bin libmetis-dev" # mpirun; its tests too
packages_pictures="libvtk9-dev libx11-dev xvfb xauth libgl1-mesa-dri"
packages_python="python3-h5py python3-pandas python3-matplotlib"
packages_browser="chromium"
packages_micro="libbenchmark-dev"
packages_instructions="valgrind"
packages_format="clang-format-14"
packages_fuzz="clang-14 libclang-rt-14-dev libomp-14-dev"
packages_coverage="llvm-14"
packages_package="dpkg-dev file" # which CPack asks what is a program
packages_bare="mmdebstrap ca-certificates"
packages_cache="ccache"

# need_packages PACKAGE...: installs those that are missing; says which, and where it may not, what
# to type.
need_packages() {
  missing=""
  for package in "$@"; do
    # dpkg-query fails for a package that it has never heard of
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing="$missing $package"
  done
  [ -z "$missing" ] && return 0
  echo "missing Debian packages:$missing"
  if ! command -v apt-get >/dev/null 2>&1; then
    echo "this machine has no apt-get: install what these packages of Debian 12 hold, or use Debian 12" >&2
    return 4
  fi
  if [ "$(id -u)" = 0 ]; then
    as_root=""
  elif command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || { [ -t 0 ] && sudo -v; }; }; then
    as_root="sudo"
  else
    as_root="su -c"
    if command -v sudo >/dev/null 2>&1; then as_root="sudo sh -c"; fi
    echo "this needs root; run the next line and try again:" >&2
    echo "  $as_root 'apt-get update && apt-get install -y --no-install-recommends$missing'" >&2
    return 4
  fi
  echo "installing them"
  log=$(mktemp)
  if ! { $as_root apt-get update && $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends $missing; } >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    echo "apt-get failed; the lines above say why" >&2
    rm -f "$log"
    return 4
  fi
  rm -f "$log"
}
