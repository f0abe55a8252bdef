#!/usr/bin/env bash
# Draws the figures of a run: figures.sh OUTPUT_FOLDER.  Those of the tables' rows together: figures_tables.py
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) out=$1
python=$(command -v /usr/bin/python3 || command -v python3)
# A row of validate.py names itself in summary.json; case.yaml as it stands is at Re 20, closed sides, density ratio 2.
name=$(sed -n 's/.*"case": "\([^"]*\)".*/\1/p' "$out/summary.json" 2>/dev/null || true)
case ${name:-falling_cylinder} in
  Y0[46]0-* | *-open) reference=() ;;
  *-100) reference=(--reference "$here/reference/nu0.004401.csv" --terminal "closed, body-fitted=1.635") ;;
  *-200) reference=(--reference "$here/reference/nu0.002278.csv" --terminal "closed, body-fitted=1.688") ;;
  *) reference=(--reference "$here/reference/nu0.017173.csv" --terminal "closed, body-fitted=1.2326") ;;
esac
"$python" "$here/../../scripts/plot_fall.py" "$out" "${reference[@]}"
"$python" "$here/../../scripts/plot_field.py" "$out" --weight 9810  # rho_f g, N/m3
