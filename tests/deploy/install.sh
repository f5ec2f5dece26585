#!/bin/bash
# install.sh BUILD: see README.md. Exit code 1 with a line on what is wrong.
set -u
build=$1
scratch=$(mktemp -d)
daemon=
end() {
  [ -z "$daemon" ] || { kill "$daemon" 2>/dev/null; wait "$daemon" 2>/dev/null; }
  rm -rf "$scratch"
}
trap end EXIT
fail() { echo "FAILED: $*"; exit 1; }

prefix=$scratch/usr
# What there is of components: the window and Python where they are built.
components="daemon worker cli formats"
[ ! -x "$build/bin/metamer-gui" ] || components="$components gui"
[ ! -e "$build/python/built" ] || components="$components python"
for component in $components; do
  cmake --install "$build" --component "$component" --prefix "$scratch/$component" > "$scratch/installed" ||
    fail "cmake --install --component $component"
  # Each is a Debian package: a file is of exactly one, or they don't go side by side.
  (cd "$scratch/$component" && find . ! -type d) >> "$scratch/files"
  mkdir -p "$prefix" && cp -a "$scratch/$component/." "$prefix"
done
twice=$(sort "$scratch/files" | uniq -d)
[ -z "$twice" ] || fail "files of several components: $twice"
# And nothing is installed that is of none.
loose=$(grep -rl --include=cmake_install.cmake 'CMAKE_INSTALL_COMPONENT STREQUAL "Unspecified"' "$build")
[ -z "$loose" ] || fail "installed, but of no component: $loose"

rm -r "$prefix/lib/systemd" "$prefix/etc"  # they name the places of one component
cmake --install "$build" --component daemon --prefix "$prefix" > "$scratch/installed" || fail "cmake --install"
for file in bin/metamer bin/metamerd bin/metamer-worker lib/metamer/metamer-file-formats.so etc/metamer/metamerd.toml \
    lib/systemd/system/metamerd.service lib/systemd/system/metamerd.socket lib/sysusers.d/metamer.conf \
    lib/tmpfiles.d/metamer.conf share/man/man1/metamer.1 share/man/man8/metamerd.8 share/man/man5/metamerd.toml.5; do
  [ -s "$prefix/$file" ] || fail "$file is not installed"
done
grep -rq '@BINDIR@\|@CONFIG@' "$prefix/lib/systemd" && fail "the unit has a place that was not put in"

# What an administrator has written stays.
echo '# mine' >> "$prefix/etc/metamer/metamerd.toml"
cmake --install "$build" --component daemon --prefix "$prefix" > /dev/null || fail "a second cmake --install"
tail -1 "$prefix/etc/metamer/metamerd.toml" | grep -q '# mine' || fail "an install overwrites metamerd.toml"

config=$prefix/etc/metamer/metamerd.toml
"$prefix/bin/metamerd" --check-config "$config" || fail "metamerd --check-config"
server=unix:$scratch/socket
"$prefix/bin/metamerd" --config "$config" --state "$scratch/state" --listen "$server" 2> "$scratch/log" &
daemon=$!
for _ in $(seq 200); do
  [ -S "$scratch/socket" ] && break
  kill -0 "$daemon" 2>/dev/null || { cat "$scratch/log"; fail "metamerd ended"; }
  sleep 0.1
done
said=$("$prefix/bin/metamer" info --health --server "$server") || { cat "$scratch/log"; fail "--health: $said"; }
[ "$said" = healthy ] || fail "--health said: $said"
"$prefix/bin/metamer" stats --json --server "$server" | grep -q metamer_sessions_total || fail "metamer stats"
kill -TERM "$daemon"
wait "$daemon" || fail "metamerd's exit code after SIGTERM: $?"
daemon=
"$prefix/bin/metamer" info --health --server "$server" 2> /dev/null
[ $? = 3 ] || fail "--health of a server that is not there"

# Sockets that systemd holds: a client that comes first has the daemon started, and their file stays.
if command -v systemd-socket-activate > /dev/null; then
  systemd-socket-activate -l "$scratch/activated" "$prefix/bin/metamerd" --state "$scratch/state" 2> "$scratch/log" &
  daemon=$!
  for _ in $(seq 200); do [ -S "$scratch/activated" ] && break; sleep 0.1; done
  "$prefix/bin/metamer" info --health --server "unix:$scratch/activated" > /dev/null ||
    { cat "$scratch/log"; fail "--health of an activated daemon"; }
  kill -TERM "$daemon"
  wait "$daemon" || fail "an activated metamerd's exit code: $?"
  daemon=
  [ -S "$scratch/activated" ] || fail "an activated metamerd removes a socket that is not its own"
fi

if command -v groff > /dev/null; then
  for page in "$prefix"/share/man/man?/*; do
    warnings=$(groff -Kutf8 -man -Tutf8 -ww "$page" 2>&1 > /dev/null)
    [ -z "$warnings" ] || fail "$page: $warnings"
  done
fi
if command -v systemd-analyze > /dev/null; then
  units=$prefix/lib/systemd/system
  warnings=$(systemd-analyze verify --man=no "$units/metamerd.service" "$units/metamerd.socket" 2>&1)
  [ -z "$warnings" ] || fail "systemd-analyze verify: $warnings"
  systemd-analyze security --offline=true --threshold=30 "$units/metamerd.service" > "$scratch/security" ||
    fail "systemd-analyze security: $(tail -1 "$scratch/security")"
fi
echo "ok"
