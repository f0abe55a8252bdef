#!/usr/bin/env python3
"""The waves at a run's free-surface gauges, and which part of them is incident and which reflected.

Usage: scripts/waves.py FOLDER --depth D NAME=X [NAME=X ...] [--period T] [--from TIME] [--to TIME] [--level Y] [--gravity 9.81] [--png]
NAME: a gauge of fluid.probes with `surface` along y, X its place, m.  D: of still water, m.  The elevation is the column `last` of
fluid_probes.csv above Y, or above what the gauge's first row has.  --from and --to, s: of rows where waves have come to all gauges and what is
reflected has come back, and before what is reflected a second time arrives.

Prints of each gauge the mean elevation, H_m0 = 4 standard deviations, and of its waves from zero upcrossing to zero upcrossing their number,
mean period and height, H_1/3 and the highest.  Of two gauges or more, which waves of length 2 pi/k from omega^2 = g k tanh kd run to larger x
(incident) and to smaller x (reflected), by least squares at all gauges (Mansard and Funke 1980; Zelt and Skjelbreia 1992):
  with --period   of the regular wave of this period: its height both ways, and what the gauges have of this period that neither explains.
                  Overtones, of bound waves and free ones, are told beside it, not separated
  without         of each frequency, from half to three times that of the spectrum's peak: H_m0 both ways, and the spectra in FOLDER/waves.csv.
                  Frequencies at which the gauges stand half wave lengths apart tell nothing; they are left out, and what they have is told
--png: a picture of elevations and spectra, FOLDER/waves.png.
"""
import argparse
import os
import sys

import numpy as np

from series import read_series
from wavemaker import wave_number

SINGULAR = 0.1  # of the determinant of the least squares, over that of gauges a quarter of a wave length apart: below it they tell nothing
BAND = (0.5, 3.0)  # of the frequency of the spectrum's peak
TAPER = 0.1  # of the record at each end
SMOOTHED = 9  # frequencies that a row of waves.csv is the mean of


def refuse(text):
    sys.exit("waves.py: error: " + text)


def harmonic(t, values, omega, overtones=1):
    """Complex amplitudes [1 + overtones] of Re sum X_k e^{-i (k+1) omega t}, by least squares beside what changes slowly."""
    phase, slow = np.outer(np.arange(1, overtones + 2), omega * t), (t - t[0]) / (t[-1] - t[0])
    columns = [*np.cos(phase), *np.sin(phase), np.ones_like(slow), slow, slow**2]
    fit = np.linalg.lstsq(np.array(columns).T, values, rcond=None)[0]
    return fit[:overtones + 1] + 1j * fit[overtones + 1:2 * overtones + 2]


def split(places, values, k):
    """Amplitudes at x = 0 of the waves to larger x and to smaller x, and what is left at each gauge; values: complex, [gauges], of
    Re(... e^{-i omega t})."""
    waves = np.exp(1j * k * np.outer(places, (1.0, -1.0)))
    fit = np.linalg.lstsq(waves, values, rcond=None)[0]
    return fit[0], fit[1], values - waves @ fit


def tells(places, k):
    """1 where gauges tell the two directions apart best, 0 where not at all: 1 - |mean of e^{2 i k x}|^2."""
    return 1.0 - np.abs(np.exp(2j * np.outer(np.atleast_1d(k), places)).mean(axis=1))**2


def upcrossings(t, values):
    """Heights and periods of the waves between zero upcrossings."""
    k = np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0))
    times = t[k] - values[k] * (t[k + 1] - t[k]) / (values[k + 1] - values[k])
    heights = np.array([np.ptp(values[a:b + 1]) for a, b in zip(k[:-1], k[1:])])
    return heights, np.diff(times)


def spectrum(t, values):
    """Complex amplitudes of Re(... e^{-i omega t}) at 0, 1/length, ..., of an even record, tapered at its ends, with the variance that it had."""
    n = len(t)
    window = np.interp(np.arange(n), [0, TAPER * n, (1.0 - TAPER) * n, n], [0.0, np.pi, np.pi, 0.0])
    window = 0.5 * (1.0 - np.cos(window))
    slow = np.polyval(np.polyfit(t - t[0], values, 1), t - t[0])
    return np.conj(np.fft.rfft((values - slow) * window)) * 2.0 / n / np.sqrt(np.mean(window**2))


def irregular(t, elevation, places, depth, gravity):
    """Frequencies of the band, variance of each of the waves both ways (nan where the gauges do not tell) and mean of the gauges'."""
    even = np.linspace(t[0], t[-1], len(t))
    f = np.fft.rfftfreq(len(t), even[1] - even[0])
    values = np.array([spectrum(even, np.interp(even, t, e)) for e in elevation])
    variance = 0.5 * (abs(values)**2).mean(axis=0)
    smooth = np.convolve(variance, np.ones(SMOOTHED), "same")
    smooth[0] = 0.0
    if not smooth.max() > 0.0:
        refuse("there are no waves at the gauges")
    peak = f[smooth.argmax()]
    band = (f >= BAND[0] * peak) & (f <= BAND[1] * peak)
    if band.sum() < 2 * SMOOTHED:
        refuse("the record has %d frequencies from half to three times that of the peak, %.4g 1/s: expected %d or more, a record of %.3g s; for a regular wave give --period" %
               (band.sum(), peak, 2 * SMOOTHED, 2 * SMOOTHED / ((BAND[1] - BAND[0]) * peak)))
    k = wave_number(2.0 * np.pi * f[band], depth, gravity)
    ways = np.array([split(places, v, q)[:2] for v, q in zip(values[:, band].T, k)])
    ways[tells(places, k) < SINGULAR] = np.nan
    return peak, f[band], 0.5 * abs(ways.T)**2, variance[band], variance[1:].sum()


def report_gauges(names, t, elevation):
    print("gauge           mean [m]   H_m0 [m]  waves  mean T [s]  mean H [m]  H_1/3 [m]  H_max [m]")
    for name, values in zip(names, elevation):
        heights, periods = upcrossings(t, values - values.mean())
        text = "%-14s %9.5f  %9.5f  %5d" % (name, values.mean(), 4.0 * values.std(), len(heights))
        if len(heights):
            highest = np.sort(heights)[-max(1, round(len(heights) / 3)):]
            text += "  %10.4f  %10.5f  %9.5f  %9.5f" % (periods.mean(), heights.mean(), highest.mean(), heights.max())
        print(text)


def report_regular(o, t, elevation, places):
    omega = 2.0 * np.pi / o.period
    k = wave_number(omega, o.depth, o.gravity)
    if t[-1] - t[0] < o.period:
        refuse("the record is %.4g s long: expected a period or more" % (t[-1] - t[0]))
    fits = np.array([harmonic(t, e, omega, 2) for e in elevation])
    print("of %g s: " % o.period + ", ".join("%s %.5f m high" % (name, 2.0 * abs(h[0])) for name, h in zip(o.gauges, fits)))
    print("its overtones, of two and three times its frequency: " + ", ".join("%.5f, %.5f m" % tuple(2.0 * abs(h[1:])) for h in fits))
    if len(places) < 2:
        return
    if tells(places, k)[0] < SINGULAR:
        refuse("the gauges are too near each other, or half wave lengths apart, %.4g m: they do not tell incident and reflected waves apart" % (np.pi / k))
    incident, reflected, left = split(places, fits[:, 0], k)
    print("wave length %.6g m; incident %.5f m high, reflected %.5f m: %.1f %%; left at the gauges %s" %
          (2.0 * np.pi / k, 2.0 * abs(incident), 2.0 * abs(reflected), 100.0 * abs(reflected / incident), ", ".join("%.5f m" % (2.0 * abs(v)) for v in left)))


def report_irregular(o, t, elevation, places):
    peak, f, ways, variance, total = irregular(t, elevation, places, o.depth, o.gravity)
    known = np.isfinite(ways[0])
    if not known.any():
        refuse("the gauges tell incident and reflected waves apart at no frequency of the band")
    incident, reflected = 4.0 * np.sqrt(np.nansum(ways, axis=1))
    print("peak at %.4g s; from %.4g to %.4g 1/s: incident H_m0 %.5f m, reflected %.5f m: %.1f %%; the gauges do not tell of %.1f %% of the variance there; %.1f %% is at other frequencies" %
          (1.0 / peak, f[0], f[-1], incident, reflected, 100.0 * reflected / incident, 100.0 * variance[~known].sum() / variance.sum(), 100.0 * (1.0 - variance.sum() / total)))
    spacing, n = f[1] - f[0], len(f) // SMOOTHED * SMOOTHED
    mean = lambda v: v[:n].reshape(-1, SMOOTHED).mean(axis=1)
    rows = np.array([mean(f), mean(variance) / spacing, mean(ways[0]) / spacing, mean(ways[1]) / spacing])
    path = os.path.join(o.folder, "waves.csv")
    np.savetxt(path, rows.T, "%.9g", ",", header="f [1/s],gauges [m2 s],incident [m2 s],reflected [m2 s]", comments="")
    print("wrote " + path)
    return rows


def draw(path, names, t, elevation, rows):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1 if rows is None else 2, 1, figsize=(9, 3.2 if rows is None else 6), squeeze=False)
    for name, values in zip(names, elevation):
        axes[0, 0].plot(t, values, lw=0.8, label=name)
    axes[0, 0].set(xlabel="t [s]", ylabel="elevation [m]")
    axes[0, 0].legend(ncols=4, fontsize=8)
    if rows is not None:
        for label, values in zip(("gauges, mean", "incident", "reflected"), rows[1:]):
            axes[1, 0].plot(rows[0], values, label=label)
        axes[1, 0].set(xlabel="f [1/s]", ylabel="variance density [m$^2$ s]")
        axes[1, 0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=140)
    print("wrote " + path)


def gauge(text):
    name, equal, place = text.partition("=")
    try:
        return name, float(place)
    except ValueError:
        raise argparse.ArgumentTypeError("expected NAME=X with X in m, found '%s'" % text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("gauges", nargs="+", type=gauge, metavar="NAME=X")
    parser.add_argument("--depth", type=float, required=True)
    parser.add_argument("--period", type=float)
    parser.add_argument("--from", type=float, default=0.0, dest="begin")
    parser.add_argument("--to", type=float, default=np.inf)
    parser.add_argument("--level", type=float)
    parser.add_argument("--gravity", type=float, default=9.81)
    parser.add_argument("--png", action="store_true")
    o = parser.parse_args()
    for name in ("depth", "period", "gravity"):
        if getattr(o, name) is not None and not 0.0 < getattr(o, name) < np.inf:
            refuse("--%s: expected a number > 0" % name)
    path = os.path.join(o.folder, "fluid_probes.csv")
    if not os.path.exists(path):
        refuse("there is no %s: the case has no fluid.probes" % path)
    columns = read_series(path)
    places, o.gauges = np.array([x for _, x in o.gauges]), [name for name, _ in o.gauges]
    for name in o.gauges:
        if name + "_last" not in columns:
            there = ", ".join(c[:-5] for c in columns if c.endswith("_last"))
            refuse("there is no free-surface gauge '%s' in %s; there are: %s" % (name, path, there or "none"))
    if len(set(places)) < len(places) or len(set(o.gauges)) < len(places):
        refuse("two gauges are the same or at the same place")
    keep = (columns["t"] >= o.begin) & (columns["t"] <= o.to)
    if keep.sum() < 16:
        refuse("%d rows from %g to %g s: expected 16 or more" % (keep.sum(), o.begin, o.to))
    t, elevation = columns["t"][keep], []
    for name in o.gauges:
        values = columns[name + "_last"]
        if not np.isfinite(values[keep]).all():
            refuse("gauge '%s' has no surface in some rows: expected one that is never dry" % name)
        if o.level is None and not np.isfinite(values[0]):
            refuse("gauge '%s' has no surface in its first row: expected --level" % name)
        elevation.append(values[keep] - (values[0] if o.level is None else o.level))
    report_gauges(o.gauges, t, elevation)
    rows = None
    if o.period:
        report_regular(o, t, elevation, places)
    elif len(places) > 1:
        rows = report_irregular(o, t, elevation, places)
    if o.png:
        draw(os.path.join(o.folder, "waves.png"), o.gauges, t, elevation, rows)


if __name__ == "__main__":
    main()
