#!/usr/bin/env bash
# Downloads the meshes of CGAL's demo into build/meshes: 24 MB from the network, 29 MB on disk. They come from
# Debian's package libcgal-demo, which is unpacked and not installed. Tests and the bench use them:
#
#   RIMLINE_MODELS=build/meshes build/release/rimline bench points --check
set -u
source "$(dirname "$0")/steps.sh"

[ $# -eq 0 ] || stop "usage: $script_name"
[ ! -d build/meshes ] || { echo "$script_name: they are in $PWD/build/meshes already" && exit 0; }
command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null ||
    stop "no apt here: take data/meshes of https://github.com/CGAL/cgal, version 5.5.1"

folder=$(mktemp -d build/fetch.XXXXXX) || stop "cannot write into $PWD/build"
trap 'rm -rf "$folder"' EXIT
fetch() { (cd "$folder" && apt-get -qq -o APT::Sandbox::User=root download libcgal-demo); }
step "is there a network, and did 'apt-get update' run?" fetch
unpack() {
    dpkg-deb --extract "$folder"/libcgal-demo_*.deb "$folder" &&
        tar -xzf "$folder/usr/share/doc/libcgal-dev/data.tar.gz" -C "$folder" data/meshes
}
step "Debian 12's has usr/share/doc/libcgal-dev/data.tar.gz; has yours?" unpack
mv "$folder/data/meshes" build/meshes || stop "cannot write into $PWD/build"
echo "$script_name: $(find build/meshes -type f | wc -l) files in $PWD/build/meshes"
