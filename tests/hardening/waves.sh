#!/usr/bin/env bash
# scripts/waves.py: heights both ways are those that the elevations at gauges were made of, of a regular wave and of a spectrum, also where one gauge
# tells nothing; impossible requests are refused by one line.  No run.  Usage: waves.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
"$python" -c 'import numpy, matplotlib' 2>/dev/null || { echo 'needs numpy and matplotlib'; exit 77; }
waves="$root/scripts/waves.py"
PYTHONPATH=$root/scripts "$python" - "$scratch" <<'E2'
import os
import sys

import numpy as np

import wavemaker

G, DEPTH, LEVEL = 9.81, 0.5, 0.5
PLACES = np.array([2.0, 2.25, 2.7])
rng = np.random.default_rng(1)


def write(name, t, elevation):
    """A run's gauges; the first row is of still water."""
    folder = f"{sys.argv[1]}/{name}"
    os.mkdir(folder)
    header = "t [s]," + ",".join(f"{g}_first [m],{g}_last [m],{g}_length [m]" for g in "abc")
    rows = [t] + [LEVEL + e for e in elevation for _ in range(3)]
    np.savetxt(f"{folder}/fluid_probes.csv", np.array(rows).T, "%.12g", ",", header=header, comments="")


def way(omega, amplitude, phase, direction, t):
    k = wavemaker.wave_number(omega, DEPTH, G)
    return np.array([amplitude * np.cos(direction * k * x - omega * t + phase) for x in PLACES])


# regular, in steps that are not equal, with an overtone and a level that changes slowly
t = np.sort(np.append(0.0, 12.0 * rng.random(1500)))
omega = 2.0 * np.pi / 1.2
regular = way(omega, 0.02, 0.3, 1.0, t) + way(omega, 0.005, 1.1, -1.0, t) + 0.002 * np.cos(2.0 * omega * t) + 1e-4 * t
regular[:, 0] = 0.0
write("regular", t, regular)
# irregular: the same for a spectrum, of which 30 % come back
t = np.arange(0.0, 400.0, 0.05)
f = np.linspace(0.5, 3.0, 400) / 1.5
a = np.sqrt(wavemaker.jonswap(f, 1.0 / 1.5, 3.3))
a *= 0.25 * 0.06 * np.sqrt(2.0) / np.sqrt((a**2).sum())
irregular = sum(way(2.0 * np.pi * q, b, p, 1.0, t) + way(2.0 * np.pi * q, 0.3 * b, r, -1.0, t) for q, b, p, r in zip(f, a, *2.0 * np.pi * rng.random((2, 400))))
irregular[:, 0] = 0.0
write("irregular", t, irregular)
E2
"$python" "$waves" "$scratch/regular" --depth 0.5 a=2.0 b=2.25 c=2.7 --period 1.2 --from 0.01 >"$scratch/log"
grep -q 'incident 0.0400. m high, reflected 0.0100. m: 25.0 %; left at the gauges 0.0000. m, 0.0000. m, 0.0000. m' "$scratch/log" || { cat "$scratch/log"; exit 1; }
grep -q 'two and three times its frequency: 0.00400, 0.0000. m, ' "$scratch/log" || { cat "$scratch/log"; exit 1; }
within() { # FOUND EXPECTED BOUND
  "$python" -c 'import sys; a, b, c = map(float, sys.argv[1:]); sys.exit(not abs(a / b - 1.0) < c)' "$@" || { echo "$1, expected $2"; cat "$scratch/log"; exit 1; }
}
for gauges in 'a=2.0 b=2.25 c=2.7' 'a=2.0 b=2.25'; do
  "$python" "$waves" "$scratch/irregular" --depth 0.5 $gauges --level 0.5 --png >"$scratch/log" && [ -s "$scratch/irregular/waves.png" ] || { cat "$scratch/log"; exit 1; }
  within "$(sed -n 's/.*incident H_m0 \(\S*\) m.*/\1/p' "$scratch/log")" 0.06 0.05
  within "$(sed -n 's/.*reflected \S* m: \(\S*\) %.*/\1/p' "$scratch/log")" 30 0.05
done
# of the spectra of two gauges the incident one has, over the band, the variance of the waves that were made
PYTHONPATH=$root/scripts "$python" - "$scratch" <<'E3'
import sys

import numpy as np

from series import read_series

rows = read_series(sys.argv[1] + "/irregular/waves.csv")
there = np.isfinite(rows["incident"])
height = 4.0 * np.sqrt((rows["incident"][there] * (rows["f"][1] - rows["f"][0])).sum())
assert there.mean() > 0.8 and abs(height / 0.06 - 1.0) < 0.06, height
E3

refused() { # EXPECTED options
  if "$python" "$waves" "${@:2}" >"$scratch/out" 2>"$scratch/log"; then echo "waves of ${*:2}"; exit 1; fi
  [ "$(grep -v '^usage\|^  ' "$scratch/log" | wc -l)" -eq 1 ] && grep -q -e "$1" "$scratch/log" || { cat "$scratch/log"; exit 1; }
}
refused 'there is no .*/fluid_probes.csv: the case has no fluid.probes$' "$scratch" a=2 --depth 0.5
refused "there is no free-surface gauge 'd' in .*; there are: a, b, c$" "$scratch/regular" d=2 --depth 0.5
refused "argument NAME=X: expected NAME=X with X in m, found 'a'$" "$scratch/regular" a --depth 0.5
refused 'two gauges are the same or at the same place$' "$scratch/regular" a=2 b=2 --depth 0.5
refused 'error: --depth: expected a number > 0$' "$scratch/regular" a=2 --depth 0
refused '0 rows from 20 to inf s: expected 16 or more$' "$scratch/regular" a=2 --depth 0.5 --from 20
refused 'expected 18 or more, a record of .* s; for a regular wave give --period$' "$scratch/regular" a=2 b=2.25 --depth 0.5 --to 5
refused 'the gauges are too near each other, or half wave lengths apart, 1.024 m: they do not tell incident and reflected waves apart$' "$scratch/regular" a=2 b=2.001 --depth 0.5 --period 1.2
