#!/usr/bin/env bash
# Installs the packages that pelage needs on Debian 12. Builds pelage, tests it and times the cases of Table 1
# of Silva et al. 2010 (README.md). A second run installs nothing and rebuilds only changed files.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$root/build/release
binary=$build/pelage

usage() {
  cat <<'TEXT'
Usage: ./bootstrap.sh table1 [options of pelage run]   set up, build, time Table 1, print it beside the paper's figures
       ./bootstrap.sh test [--full] [options of ctest] set up, build, run the tests; --full: also those that take long
       ./bootstrap.sh papers [options of pelage reproduce]  set up, build, rerun the papers, write one page
       ./bootstrap.sh build                            set up and build build/release/pelage
       ./bootstrap.sh setup [FILE...]                  install the packages of packages.txt (and of each FILE) only
  --no-install before the command: do not change the system; list the missing packages instead.
  PELAGE_JOBS=N: compile N files at once (default: from cores and memory).
TEXT
}

say() { printf '[%2d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*" >&2; }
fail() { say "$@"; exit 1; }

listed() { sed 's/#.*//' "$@" | awk 'NF { print $1 }'; }

missing() {
  local package
  for package in $(listed "$@"); do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
  done
}

# Runs apt-get as root without questions. apt-get waits up to 600 s until another apt process ends.
as_root() { if ((EUID == 0)); then "$@"; else sudo "$@"; fi; }
run_apt() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600 "$@" >>"$log" 2>&1 ||
    { tail -n 20 "$log" >&2; fail "apt-get $1 failed; its complete output is in $log"; }
}

set_up() {
  local install=$1; shift
  if ! command -v dpkg-query >/dev/null; then
    [[ $install == no ]] && return  # CMake then reports missing packages
    fail "this system is not Debian: install the equivalents of packages.txt, then run ./bootstrap.sh --no-install ..."
  fi
  local wanted
  mapfile -t wanted < <(missing "$root/packages.txt" "$@")
  if ((${#wanted[@]} == 0)); then
    say "all packages are installed"
  elif [[ $install == no ]]; then
    say "missing: ${wanted[*]}"
    fail "install them: apt-get install --no-install-recommends ${wanted[*]}"
  else
    ((EUID == 0)) || command -v sudo >/dev/null ||
      fail "this needs root or sudo; run as root: apt-get install --no-install-recommends ${wanted[*]}"
    mkdir -p "$root/build"
    log=$root/build/install.log
    : >"$log"
    say "installing ${#wanted[@]} packages and their dependencies (takes minutes; log: build/install.log):"
    say "  ${wanted[*]}"
    run_apt update
    run_apt install --no-install-recommends "${wanted[@]}"
    say "installed"
  fi
  # Slim container images omit /usr/share/doc, where Debian installs CGAL's example meshes.
  if [[ $install == yes && ! -e /usr/share/doc/libcgal-dev/data.tar.gz ]]; then
    mkdir -p "$root/build"
    log=$root/build/install.log
    say "reinstalling CGAL's meshes, because this system omits /usr/share/doc"
    run_apt install --reinstall -o DPkg::Options::=--path-include='/usr/share/doc/libcgal-dev/*' libcgal-demo
  fi
}

# Prints the number of compilers to run at once: one per core, but at most one per 2 GB of memory, because compiling
# CGAL's headers needs 2 GB.
compilers() {
  local memory=$(($(awk '/^MemAvailable/ { print $2 }' /proc/meminfo) / 1024)) limit
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)
  [[ $limit == max ]] || ((limit / 1048576 > memory)) || memory=$((limit / 1048576))
  local by_memory=$((memory / 2000)) cores
  cores=$(nproc)
  local n=$((by_memory < cores ? by_memory : cores))
  echo $((n < 1 ? 1 : n))
}

build() {
  # A build folder that was moved or copied contains wrong absolute paths.
  if [[ -e $build/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
    say "build/release belongs to another checkout: rebuilding from scratch"
    rm -rf "$build"
  fi
  [[ -e $build/build.ninja ]] || { say "configuring"; (cd "$root" && cmake --preset release >&2); }
  local n=${PELAGE_JOBS:-$(compilers)}
  say "building $* with $n compilers at once"
  cmake --build "$build" --parallel "$n" --target "$@" >&2
  say "built: $binary"
}

table1() {
  local folder='' preset=(--preset quick) argument previous='' report=yes host
  host=-$(uname -n)
  for argument in "$@"; do
    case $argument in
      --preset | --preset=*) preset=() ;;
      --anonymous) host= ;;
      --dry-run | -h | --help) report=no ;;
      -o=* | --output=* | --resume=*) folder=${argument#*=} ;;
    esac
    case $previous in -o | --output | --resume) folder=$argument ;; esac
    previous=$argument
  done
  local output=()
  if [[ -z $folder ]]; then
    folder=pelage-results/$(date -u +%Y%m%dT%H%M%SZ)$host
    output=(-o "$folder")
  fi
  if [[ $report == no ]]; then
    "$binary" run silva2010-table1 "${preset[@]}" "$@"
    return
  fi
  # --filter, --model and --shard choose other meshes than all of the experiment file.
  if [[ " $* " != *" --"[fms]* ]]; then
    say "preparing the meshes side by side; pelage run prepares one at a time"
    sed -n '/^model = /s/[^a-z0-9-]/\n/gp' "$root/experiments/silva2010-table1.toml" | grep . | tail -n +2 | tac |
      xargs -r -P "$(nproc)" -n 1 "$binary" mesh >/dev/null || true
  fi
  say "timing Table 1 into $folder"
  local status=0
  "$binary" run silva2010-table1 "${preset[@]}" "${output[@]}" "$@" || status=$?
  # `pelage run` exits with status 1 if a case has no time; the report then gives the reason. Any other error
  # ends this script.
  if ((status == 130 || status == 143)); then
    say "interrupted; to continue: ./bootstrap.sh table1 --resume $folder"
  fi
  ((status <= 1)) || exit "$status"
  "$binary" report "$folder" -o "$folder/report"
  say "report: $folder/report/index.html"
  return "$status"
}

install=yes
while [[ ${1:-} == --no-install ]]; do install=no; shift; done
command=${1:-help}
[[ $# -eq 0 ]] || shift
case $command in
  setup) set_up "$install" "$@" ;;
  build) set_up "$install"; build pelage ;;
  table1) set_up "$install"; build pelage; table1 "$@" ;;
  papers) set_up "$install"; build pelage; "$binary" reproduce "$@" ;;
  test)
    set_up "$install"
    tests=(--label-exclude full)
    if [[ ${1:-} == --full ]]; then tests=(); shift; fi
    build all
    say "running the tests"
    ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" "${tests[@]}" "$@"
    say "the test suite succeeded"
    ;;
  help | -h | --help) usage ;;
  *) usage >&2; exit 2 ;;
esac
