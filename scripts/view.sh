#!/usr/bin/env bash
# A picture of any field of a run.  Usage: scripts/view.sh RUN [--field NAME] [--time T] [--window X0 Y0 X1 Y1] [--out FILE]
exec "$(command -v /usr/bin/python3 || command -v python3)" "$(dirname "$(readlink -f "$0")")/view.py" "$@"
