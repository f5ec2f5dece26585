# Configures and builds a preset, and says how long that took. Sourced by demo and test.

# clock SECONDS: as people read it.
clock() {
  if (($1 < 60)); then echo "$1 s"; else printf '%d min %02d s\n' $(($1 / 60)) $(($1 % 60)); fi
}

# configure PRESET: only where it has not been done or the presets have changed since; Ninja looks
# after every other change.
configure() {
  local cache=$root/build/$1/CMakeCache.txt
  if [[ -f $root/build/$1/build.ninja && $cache -nt $root/CMakePresets.json ]]; then return; fi
  (cd "$root" && cmake --preset "$1") && touch "$cache"
}

# build PRESET [TARGET…]: configures if need be, builds, and says how long both took.
build() {
  local preset=$1 started=$SECONDS fresh=again configured limit=600
  shift
  [[ -f $root/build/$preset/build.ninja ]] || fresh=fresh
  configure "$preset" || return
  configured=$SECONDS
  cmake --build "$root/build/$preset" -j "$(nproc)" --target "${@:-all}" || return
  echo "Build ($preset, $fresh, $(nproc) cores$(command -v ccache >/dev/null && echo ", ccache")):" \
    "configured in $(clock $((configured - started))), built in $(clock $((SECONDS - configured)))."
  if ((SECONDS - started > limit)); then
    echo "That is more than the $(clock $limit) that a build on two cores may take." >&2
  fi
}
