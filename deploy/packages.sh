# Installs the Debian packages that are missing, and touches nothing else. Sourced by demo and test.

# wanted_packages SECTION…: the packages of those sections of deploy/dependencies.
wanted_packages() {
  local section
  for section in "$@"; do
    awk -v section="[$section]" '/^\[/ { inside = ($1 == section); next }
                                 /^#/ || NF == 0 { next }
                                 inside { print $1 }' "$root/deploy/dependencies"
  done
}

# why PACKAGE: its words in deploy/dependencies.
why() {
  awk -v name="$1" '$1 == name { $1 = ""; print substr($0, 2) }' "$root/deploy/dependencies"
}

is_installed() {
  [[ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

# say_what_goes PACKAGE…: lists the packages that apt would remove to make room for these.
say_what_goes() {
  local removed
  removed=$(apt-get install -s --no-install-recommends "$@" | awk '$1 == "Remv" { print "  " $2 }')
  [[ -z "$removed" ]] && return
  echo "These have to go, because the new packages replace them"
  echo "(libboost1.81-dev replaces the headers of Boost 1.74):"
  echo "$removed"
}

# install_missing SECTION…: one apt-get install for everything that is missing; no call to apt
# where nothing is.
install_missing() {
  local package missing=() as_root=(env)
  while read -r package; do
    is_installed "$package" || missing+=("$package")
  done < <(wanted_packages "$@")
  if ((${#missing[@]} == 0)); then
    echo "Packages: nothing is missing."
    return
  fi

  echo "Packages that are missing, and what they are for:"
  for package in "${missing[@]}"; do printf '  %-20s %s\n' "$package" "$(why "$package")"; done
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      echo "Installing them takes root, and there is no sudo here. As root, run:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    }
    as_root=(sudo env)
    echo "They are installed through sudo, which may ask for your password."
  fi


  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get update -qq
  say_what_goes "${missing[@]}"
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
}
