# Sourced by the scripts that build and test. They run from the repository's root, one step after
# another, and stop at the first that fails with one line that says what to do.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
script_name=${0#"$PWD"/}

stop() {
    echo "$script_name: $1" >&2
    exit 1
}

# step ADVICE COMMAND...: runs the command; when it fails, its own output and the advice remain.
step() {
    local advice=$1
    shift
    "$@" || stop "'$*' failed: $advice"
}

mkdir -p build || stop "cannot write here: make $PWD writable for $(id -un), then run this again"

# The CPU Vulkan driver compiles pipelines anew in every process unless its cache outlives them. The
# place may be anywhere writable; here nothing outside the tree is touched.
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$PWD/build/shader_cache}

# Servers and containers often have none, and graphics libraries complain about that.
if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    mkdir -p -m 700 build/runtime
    export XDG_RUNTIME_DIR=$PWD/build/runtime
fi
