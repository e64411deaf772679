#!/usr/bin/env bash
# Compares the compilers: builds bench_levels with gcc and clang for each back end and prints how much slower gcc is.
#
#   compilers.sh SOURCE_ROOT BACKEND... [-- ARGUMENT of bench_levels...]
#
# The programs take turns, three rounds; the times of a row are the median of the rounds. The builds lie in a temporary folder
# and leave out what is not measured.
set -euo pipefail

root=$1
shift
backends=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  backends+=("$1")
  shift
done
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- --size 256 --repeat 3

for tool in gcc g++ clang clang++ meson ninja; do
  if ! command -v "$tool" >/dev/null; then
    echo "# skipped: there is no $tool"
    exit 77
  fi
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() { # compiler, C++ compiler, back end
  local folder=$work/$1-$3
  if ! { CC=$1 CXX=$2 meson setup "$folder" "$root" -Dhost_backend="$3" -Dgltf=disabled -Dimages=disabled -Doracles=disabled &&
    ninja -C "$folder" tests/bench/bench_levels; } >"$work/log" 2>&1; then
    cat "$work/log" >&2
    exit 1
  fi
}

for backend in "${backends[@]}"; do
  build gcc g++ "$backend"
  build clang clang++ "$backend"
  for round in 1 2 3; do
    for compiler in gcc clang; do
      "$work/$compiler-$backend/tests/bench/bench_levels" "$@" >"$work/$compiler-$backend-$round.csv"
    done
  done
done

for compiler in gcc clang; do
  grep -h '^# compiler' "$work/$compiler-${backends[0]}-1.csv" | sed 's/, back end.*//'
done
echo "row,backend,gcc_seconds,clang_seconds,gcc_times_clang"
awk -F, '
  function median(a, b, c) { return a > b ? (b > c ? b : (a > c ? c : a)) : (a > c ? a : (b > c ? c : b)) }
  /^levels\// {
    part = FILENAME
    sub(/.*\//, "", part)
    split(part, name, /[-.]/) # compiler, back end, round
    key = $1 "," name[2]
    if (!(key in seen)) {
      seen[key] = 1
      order[++rows] = key
    }
    time[key, name[1], name[3]] = $3
  }
  END {
    for (i = 1; i <= rows; i++) {
      key = order[i]
      gcc = median(time[key, "gcc", 1], time[key, "gcc", 2], time[key, "gcc", 3])
      clang = median(time[key, "clang", 1], time[key, "clang", 2], time[key, "clang", 3])
      printf "%s,%.6f,%.6f,%.3f\n", key, gcc, clang, gcc / clang
      if (gcc / clang > worst) {
        worst = gcc / clang
        where = key
      }
    }
    printf "# target: gcc takes at most 1.3 times as long as clang: %s (%.3f in %s)\n",
      worst <= 1.3 ? "reached" : "not reached", worst, where
  }' "$work"/*.csv
