# Sourced by the scripts that build and test. They run from the root of the repository, one step after
# another. The first step that fails ends the script with one line that says what to do.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
script_name=${0#"$PWD"/}

stop() {
    echo "$script_name: $1" >&2
    exit 1
}

# step ADVICE COMMAND...: runs the command; where it fails, ends the script with the advice.
step() {
    local advice=$1
    shift
    "$@" || stop "'$*' failed: $advice"
}

mkdir -p build || stop "cannot write here: make $PWD writable for $(id -un), then run this again"

# The CPU Vulkan driver compiles pipelines in every process anew unless it has a cache on disk. Here it is
# inside the tree, so that no file outside is written.
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$PWD/build/shader_cache}

# Servers and containers often have none, and graphics libraries warn about that.
if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    mkdir -p -m 700 build/runtime
    export XDG_RUNTIME_DIR=$PWD/build/runtime
fi
