#!/usr/bin/env bash
# Usage: test.sh ROOT BUILD
exec "$(dirname "$0")/../compare_disc.sh" template_fortran "$@"
