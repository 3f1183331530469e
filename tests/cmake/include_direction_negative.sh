#!/usr/bin/env bash
# The include check must find what it is for: here a tree of one file with one wrong arrow.
set -eu
check=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/engine"
printf '#include "planning/pipeline/pipeline.h"\n' > "$root/engine/leak.h"
cmake -DROOT="$root" -P "$check" 2>&1 | grep -q "engine may not know"
rm "$root/engine/leak.h"
printf 'const auto card = nlohmann::json::parse(text);\n' > "$root/engine/card.cpp"
cmake -DROOT="$root" -P "$check" 2>&1 | grep -q "card.cpp.*bounded_json.h"
