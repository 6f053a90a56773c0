#!/usr/bin/env bash
# Makes three.min.js anew from the versions in package-lock.json. Needs npm; the build of foldmotion does not.
set -euo pipefail
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp package.json package-lock.json entry.js "$work"
(cd "$work" && npm ci --silent)
version=$(node -p "require('$work/node_modules/three/package.json').version")
{
    printf '/*! three.js %s\n\n' "$version"
    cat "$work/node_modules/three/LICENSE"
    printf '*/\n'
    "$work/node_modules/.bin/esbuild" "$work/entry.js" --bundle --minify --format=iife --global-name=THREE \
        --target=es2020 --legal-comments=none --charset=ascii --log-level=warning
} >three.min.js
cp "$work/node_modules/three/LICENSE" LICENSE
if grep -qi '</script\|<!--' three.min.js; then
    echo "three.min.js would end its script element" >&2
    exit 1
fi
