#!/usr/bin/env bash
# Draws the figures of a run: figures.sh OUTPUT_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$(command -v /usr/bin/python3 || command -v python3)
"$python" "$here/figures.py" "$1"
