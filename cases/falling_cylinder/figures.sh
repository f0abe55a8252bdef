#!/usr/bin/env bash
# Draws the figures of a run: figures.sh OUTPUT_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) out=$1
python=$(command -v /usr/bin/python3 || command -v python3)
"$python" "$here/../../scripts/plot_fall.py" "$out" --reference "$here/reference/nu0.017173.csv" \
  --terminal "closed, body-fitted=1.2326"
"$python" "$here/../../scripts/plot_field.py" "$out"
