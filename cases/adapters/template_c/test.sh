#!/usr/bin/env bash
# The disc in C falls as the elastic one of FEMDEM.  Usage: test.sh ROOT BUILD
set -euo pipefail
source "$1/tests/coupled/run.sh"
program=$("$root/cases/adapters/build.sh" template_c "$build")
must femdem 1:1:1 --set time.end=0.3
must other 1:1:2 --set time.end=0.3 --solid "$program"
"$root/cases/adapters/compare.py" "$scratch/other" "$scratch/femdem" 0.01
