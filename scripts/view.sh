#!/usr/bin/env bash
# A picture of any field of a run, or an animation.  Usage: scripts/view.sh RUN [--field NAME] [--time T | --animate] [--window X0 Y0 X1 Y1]
#   [--range LOW HIGH] [--out FILE]
exec "$(command -v /usr/bin/python3 || command -v python3)" "$(dirname "$(readlink -f "$0")")/view.py" "$@"
