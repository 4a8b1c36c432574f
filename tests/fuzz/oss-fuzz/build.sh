#!/bin/bash -eu
# Builds the fuzz targets as OSS-Fuzz asks for them: into $OUT, with their seeds, dictionaries and shared libraries.
build=$WORK/rimline
cmake -S "$SRC/rimline" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Sanitized -DCMAKE_UNITY_BUILD=ON -DRIMLINE_FUZZ=ON \
    -DRIMLINE_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" -DRIMLINE_ENGINE=OFF -DRIMLINE_METHODS=OFF -DRIMLINE_TESTS=OFF \
    -DRIMLINE_INSTALL=OFF
cmake --build "$build"
mkdir -p "$OUT/lib"
for program in "$build"/tests/fuzz/fuzz_*; do
    [ -x "$program" ] && [ -f "$program" ] || continue
    name=$(basename "$program")
    target=${name#fuzz_}
    cp "$program" "$OUT/"
    zip -qj "$OUT/${name}_seed_corpus.zip" "$build/tests/fuzz/corpora/$target/"*
    case $target in
        mesh_glb) words=gltf ;;
        point_file) words=xyz ;;
        scene_file) words=scene ;;
        *) words=${target#mesh_} ;;
    esac
    dictionary=$SRC/rimline/tests/fuzz/dictionaries/$words.dict
    [ ! -f "$dictionary" ] || cp "$dictionary" "$OUT/$name.dict"
    ldd "$program" | awk '/=> \/(usr|lib)/ { print $3 }' | grep -Ev '/(libc|libm|libpthread|libdl|librt)\.so' |
        xargs -r -I{} cp -n {} "$OUT/lib/"
    patchelf --set-rpath '$ORIGIN/lib' "$OUT/$name"
done
