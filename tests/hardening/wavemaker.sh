#!/usr/bin/env bash
# scripts/wavemaker.py: its tables are those of the theory that it names, cases take them as it prints them, and impossible waves are refused by one
# line.  No run.  Usage: wavemaker.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
"$python" -c 'import numpy' 2>/dev/null || { echo 'needs numpy'; exit 77; }
maker="$root/scripts/wavemaker.py"
"$python" "$maker" regular --height 0.04 --period 1.2 --depth 0.5 --end 9.6 >"$scratch/regular"
"$python" "$maker" regular --height 0.04 --period 1.2 --depth 0.5 --end 9.6 --flap 0.3 0.1 >"$scratch/flap"
"$python" "$maker" solitary --height 0.06 --depth 0.4 --start 1 >"$scratch/solitary"
"$python" "$maker" irregular --height 0.06 --period 1.5 --depth 0.4 --end 1500 --rows 0.1 >"$scratch/irregular"
PYTHONPATH=$root/scripts "$python" - "$scratch" <<'E2'
import re
import sys

import numpy as np

import wavemaker

G = 9.81


def table(name):
    """Times, velocities and displacements, which are exact for velocities linear between rows."""
    text = open(f"{sys.argv[1]}/{name}").read()
    t, u = np.array(re.findall(r"^ +- \[(\S+), (\S+), 0\]$", text, flags=re.M), float).T
    assert u[0] == u[-1] == 0.0 and (np.diff(t) > 0.0).all(), f"{name}: the piston is not at rest before and after"
    return t, u, np.append(0.0, np.cumsum(0.5 * np.diff(t) * (u[1:] + u[:-1]))), text


def close(what, found, expected, bound):
    print("%s: %.6g, expected %.6g" % (what, found, expected))
    assert abs(found / expected - 1.0) < bound, f"{what}: {found:g}, expected {expected:g} within {bound:g} of it"


# dispersion, from shallow to deep water, by the equation itself
omega = np.geomspace(0.01, 100.0, 101)
k = wavemaker.wave_number(omega, 0.5, G)
assert (abs(G * k * np.tanh(0.5 * k) / omega**2 - 1.0) < 1e-10).all(), "a wave number does not satisfy the dispersion relation"

# regular: H/S in the other form; a sine that is linear between n rows a period is too small by (2 pi/n)^2/12, n 50
t, u, x, text = table("regular")
k = wavemaker.wave_number(2.0 * np.pi / 1.2, 0.5, G)
stroke = 0.04 * (np.sinh(k) + k) / (2.0 * (np.cosh(k) - 1.0))  # 2kd is k
whole = (t > 2.4) & (t < 9.6)
close("regular: half the stroke", abs(x[whole]).max(), 0.5 * stroke, 2.0 * (2.0 * np.pi / 50)**2 / 12.0)
fit = np.polyfit(np.sin(2.0 * np.pi / 1.2 * t[whole]), u[whole], 1)
close("regular: velocity", fit[0], np.pi * stroke / 1.2, 1e-4)
close("regular: velocity of the linear rise", float(re.search(r"velocity: \[(\S+),", text).group(1)), np.pi * stroke / 1.2, 1e-5)
close("regular: velocity of cases/floating_platform", fit[0], 0.0738, 0.005)
assert abs(x[-1]) < 1e-3 * stroke, "regular: the piston does not come back"

# a flap: H/S as Dean and Dalrymple (1991) give it, the angle by the table, clockwise as the waves go; its rows are linear, as the piston's
k = wavemaker.wave_number(2.0 * np.pi / 1.2, 0.5, G)
kd = 0.5 * k
stroke = 0.04 * (np.sinh(2.0 * kd) + 2.0 * kd) / (4.0 * np.sinh(kd) / kd * (kd * np.sinh(kd) - np.cosh(kd) + 1.0))
flap = open(f"{sys.argv[1]}/flap").read()
at, spin = np.array(re.findall(r"^ +- \[(\S+), (\S+)\]$", flap, flags=re.M), float).T
angle = np.append(0.0, np.cumsum(0.5 * np.diff(at) * (spin[1:] + spin[:-1])))
close("flap: its angle", -np.interp(2.4 + 0.6, at, angle), np.arctan(0.5 * stroke / 0.5), 2.0 * (2.0 * np.pi / 50)**2 / 12.0)
assert "pivot: [0.3, 0.1]" in flap and np.corrcoef(spin[(at > 2.4) & (at < 9.6)], u[whole])[0, 1] < -0.999, "flap: it does not turn as the piston moves"

# solitary: the stroke is the wave's volume 2 H/kappa over d, less what tails below 1e-3 of the height have: 1 - sqrt(1 - 1e-3) of it
t, u, x, text = table("solitary")
kappa, c = np.sqrt(0.75 * 0.06 / 0.4**3), np.sqrt(G * 0.46)
stroke = 2.0 * 0.06 / (kappa * 0.4)
assert t[0] == 1.0, "solitary: it does not begin at --start"
close("solitary: stroke", x[-1], stroke, 1e-3)
close("solitary: velocity", u.max(), c * 0.06 / 0.46, 1e-3)
middle = np.interp(0.5 * x[-1], x, t)
error = abs(x - 0.5 * x[-1] - 0.5 * stroke * np.tanh(kappa * (c * (t - middle) - (x - 0.5 * x[-1])))).max()
assert error < 2e-3 * stroke, "solitary: %g m from Goring's equation" % error

# irregular: the spectrum of the motion, each frequency by its transfer function; a thousand waves scatter by some 2 %
t, u, x, text = table("irregular")
f = np.fft.rfftfreq(len(t), t[1] - t[0])
band = (f > 0.4 / 1.5) & (f < 3.2 / 1.5)
omega = 2.0 * np.pi * f[band]
kd = 0.4 * wavemaker.wave_number(omega, 0.4, G)
elevation = abs(np.fft.rfft(u))[band] / omega * 2.0 * np.sinh(kd)**2 / (np.sinh(2.0 * kd) + 2.0 * kd) * 2.0
energy = 2.0 * (elevation / len(t))**2
close("irregular: significant height", 4.0 * np.sqrt(energy.sum() * t[-1] / 1500.0), 0.06, 0.05)
close("irregular: as it says", float(re.search(r"1500 s: (\S+) m", text).group(1)), 0.06, 0.05)
# the mean period m0/m1 with gamma 3.3 is 0.8348 of that of the peak (DNV-RP-C205); of the part from 0.5 to 3 times the peak's frequency 0.8546
f_all = np.linspace(0.05, 50.0, 200001)
spectrum = wavemaker.jonswap(f_all, 1.0, 3.3)
close("irregular: mean period of the spectrum", spectrum.sum() / (spectrum * f_all).sum(), 0.8348, 2e-3)
close("irregular: mean period", energy.sum() / (energy * f[band]).sum(), 0.8546 * 1.5, 0.03)
E2
irregular() { "$python" "$maker" irregular --height 0.06 --period 1.5 --depth 0.4 --end 15 --line "$@"; }
line=$(irregular)
[ "$line" != "$(irregular --seed 2)" ] || { echo 'a seed is not another sample'; exit 1; }

# a case takes the rows pasted into a body, and the table in one line from --set
sed -e "/^      prescribed:/{r $scratch/solitary" -e 'd}' "$root/cases/floating_platform/case.yaml" >"$scratch/pasted.yaml"
grep -q '^            - \[1.05, ' "$scratch/pasted.yaml" || { echo 'nothing was pasted'; exit 1; }
"$root/scripts/check.sh" --bin "$build" "$scratch/pasted.yaml" --set "solid.bodies[1].prescribed=[{table: $line}]" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }

refused() { # EXPECTED options
  if "$python" "$maker" "${@:2}" >"$scratch/out" 2>"$scratch/log"; then echo "a wave of ${*:2}"; exit 1; fi
  [ "$(grep -v '^usage\|^  ' "$scratch/log" | wc -l)" -eq 1 ] && [ ! -s "$scratch/out" ] && grep -q -e "$1" "$scratch/log" || { cat "$scratch/log"; exit 1; }
}
refused 'error: argument --height: expected a number > 0, found .0.$' regular --height 0 --period 1 --depth 1 --end 9
refused 'error: --height 0.4: a solitary wave in water 0.5 m deep breaks above 0.39 m$' solitary --height 0.4 --depth 0.5
refused 'error: --height 0.3: waves of 1.2 s in water 0.5 m deep break above 0.265 m$' regular --height 0.3 --period 1.2 --depth 0.5 --end 9
refused 'error: --rows 0.3: too coarse for this motion, expected at most 0.12$' regular --height 0.1 --period 1.2 --depth 0.5 --end 9 --rows 0.3
refused 'error: more than 100000 rows: expected a larger --rows or a smaller --end$' regular --height 0.1 --period 1.2 --depth 0.5 --end 9 --rows 1e-5
refused 'error: --end 4: the waves rise until 3 s: expected twice that or more$' irregular --height 0.06 --period 1.5 --depth 0.4 --end 4
