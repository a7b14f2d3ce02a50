# Packages and builds of this source tree; sourced by the commands that a user types, with `top` set
# to the top of the tree. Goes there.

. "$top/benchmarks/setup/packages.sh"
cd "$top"

# quietly COMMAND...: its words are shown only where it fails.
quietly() {
  words=$(mktemp)
  failed=0
  "$@" >"$words" 2>&1 || failed=$?
  [ "$failed" = 0 ] || cat "$words" >&2
  rm -f "$words"
  return "$failed"
}

# configure PRESET [OPTION...]: CMake's words are shown only where it fails. DIPTYCH_CONFIGURE holds
# options for every call, such as -DCMAKE_COMPILE_WARNING_AS_ERROR=ON.
configure() {
  preset=$1
  shift
  fresh=""
  cache=build/$preset/CMakeCache.txt
  if [ -f "$cache" ]; then
    made_for=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
    if [ "$made_for" != "$top" ] && ! [ "$made_for" -ef "$top" ]; then
      echo "build/$preset was configured for $made_for; configuring it anew for this place"
      fresh=--fresh
    fi
  fi
  words=$(mktemp)
  if ! cmake $fresh --preset "$preset" ${DIPTYCH_CONFIGURE:-} "$@" >"$words" 2>&1; then
    cat "$words" >&2
    rm -f "$words"
    echo "CMake could not configure build/$preset; the lines above say why" >&2
    return 4
  fi
  sed -n 's/^-- \(Not tested.*\)/\1/p' "$words" # what is optional and not here
  rm -f "$words"
}

# build PRESET [TARGET...]: all where no target is named.
build() {
  preset=$1
  shift
  echo "building ($preset)"
  cmake --build --preset "$preset" ${1:+--target "$@"}
}
