#!/usr/bin/env bash
# Usage: test.sh ROOT BUILD
exec "$(dirname "$0")/../compare_dust.sh" template_fluid_c "$@"
