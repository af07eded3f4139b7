# What a fresh Debian or Ubuntu needs, and how it gets there.  Sourced by app/run and tests/run; bash.

# Tools are looked for by command, so that one from elsewhere than the system's packages is as good: COMMAND=PACKAGE.
build_tools=(c++=g++ cmake=cmake ninja=ninja-build pkg-config=pkg-config)
build_packages=(libeigen3-dev nlohmann-json3-dev libcli11-dev libspng-dev libjpeg-dev libexif-dev libstb-dev
  libxxhash-dev libzip-dev libpugixml-dev libimgui-dev libglfw3-dev libepoxy-dev)
test_packages=(libgtest-dev libxtst-dev libx11-dev xvfb libgl1-mesa-dri)
sanitizer_packages=(clang libclang-rt-dev)

# Prints those of the packages $@ that dpkg does not have installed.  One dpkg-query, no apt: this runs at every start.
list_absent_packages() {
  local installed package
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed $package"$'\n'* ]] || printf '%s\n' "$package"
  done
}

# Prints the packages that are missing to build with; $@ names packages wanted besides the libraries.
list_missing_packages() {
  local tool
  for tool in "${build_tools[@]}"; do
    command -v "${tool%%=*}" >/dev/null || printf '%s\n' "${tool#*=}"
  done
  # Where there is no dpkg, CMake looks for the libraries themselves and names the ones it does not find.
  if command -v dpkg-query >/dev/null; then
    list_absent_packages "${build_packages[@]}" "$@"
  fi
}

# Says what to do by hand, and ends the script.
refuse_to_install() {
  local reason=$1
  shift
  {
    printf '\nOversketch needs packages that could not be installed: %s.\n' "$reason"
    printf 'Debian and Ubuntu call them:\n\n  sudo apt-get install --no-install-recommends %s\n\n' "$*"
    printf 'Other systems have them under similar names (third_party/README.md).  Then start this again.\n'
  } >&2
  exit 1
}

# Installs what is missing to build with, and the packages $@.  Does nothing where nothing is missing.
install_missing_packages() {
  local missing as_root=()
  mapfile -t missing < <(list_missing_packages "$@")
  ((${#missing[@]})) || return 0
  command -v apt-get >/dev/null || refuse_to_install 'there is no apt-get here' "${missing[@]}"
  if (($(id -u) != 0)); then
    command -v sudo >/dev/null || refuse_to_install 'neither root nor sudo' "${missing[@]}"
    # Without a terminal nobody could type a password: sudo then fails at once instead of waiting.
    if [[ -t 0 ]]; then as_root=(sudo); else as_root=(sudo -n); fi
  fi
  printf 'Installing: %s\n' "${missing[*]}" >&2
  # A failing update (one dead mirror of several) is not yet the end: the install decides.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2 || true
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
    -o DPkg::Lock::Timeout=300 "${missing[@]}" >&2 || refuse_to_install 'apt-get failed (see above)' "${missing[@]}"
}

# Configures the preset $1 with the settings -DNAME=VALUE, unless that has been done.  Ninja sees to later changes.
configure_once() {
  local preset=$1 setting name
  shift
  for setting in "$@"; do
    name=${setting#-D}
    # Configured otherwise, as when a library was missing: anew.
    grep -qs "^${name%%=*}:[A-Z]*=${name#*=}\$" "$project/build/$preset/CMakeCache.txt" ||
      rm -f "$project/build/$preset/build.ninja"
  done
  [[ -e $project/build/$preset/build.ninja ]] || (cd "$project" && cmake --preset "$preset" "$@" >&2)
}
