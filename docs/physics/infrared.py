"""The infrared reflectance of measured surfaces as a function of their colour: the fit of (P20).

    pip install numpy scipy colour-science && pip download --no-deps earthlib==1.1.0
    unzip earthlib-*.whl && python infrared.py earthlib/data

The spectra (MIT licence) are of soils (ICRAF-ISRIC), of roads, roofs, paints, dry plants and others
(measured at Santa Barbara), and simulated canopies (PROSAIL), 400 to 2450 nm. Every kind counts alike.
Half of the spectra are fitted, errors are those of the other half. The first band is (P20)'s; how the
others were found: reflectance.py.
"""

import csv
import sys

import colour
import numpy as np
from scipy.optimize import minimize

BANDS = [(790, 900), (1000, 1300), (1500, 1780), (2000, 2400)]
SOFT = 0.03
SRGB = np.array([[3.2406255, -1.5372080, -0.4986286], [-0.9689307, 1.8757561, 0.0415175], [0.0557101, -0.2040211, 1.0569959]])


def read(folder):
    """Kinds, wavelengths in nm, and reflectances (spectra, wavelengths)."""
    with open(f"{folder}/spectra.csv", encoding="utf-8") as file:
        kinds = np.array([row["LEVEL_3"] for row in csv.DictReader(file)])
    with open(f"{folder}/spectra.sli.hdr", encoding="utf-8") as file:
        numbers = file.read().split("wavelength = {")[1].split("}")[0]
    nm = 1000 * np.array([float(number) for number in numbers.split(",")])
    spectra = np.fromfile(f"{folder}/spectra.sli", dtype="<f4").reshape(len(kinds), len(nm)).astype(float)
    chosen = []
    for kind in sorted(set(kinds)):
        rows = np.flatnonzero((kinds == kind) & (spectra > 0).all(1))
        most = {"soil": 200, "canopy": 60}.get(kind, len(rows))
        if len(rows) >= 9:
            chosen.extend(rows[np.linspace(0, len(rows) - 1, most).astype(int)])
    return kinds[chosen], nm, spectra[chosen]


def linear_srgb(nm, spectra):
    """Linear red, green and blue under D65 by the observer of 1931."""
    grid, shape = np.arange(360, 831), colour.SpectralShape(360, 830, 1)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values
    weights = observer * colour.SDS_ILLUMINANTS["D65"].copy().align(shape).values[:, None]
    xyz = np.array([np.interp(grid, nm, spectrum) for spectrum in spectra]) @ weights / weights.sum(0)
    return np.clip(xyz * [0.950469, 1, 1.088822] @ SRGB.T, 0, None)


def fitted(coefficients, rgb):
    """m ((m + e)/(1 + e))^(p - 1), p = 2^(-k (1 - rgb/m)), m the largest channel."""
    largest = rgb.max(1)
    power = 2.0 ** -((1 - rgb / largest[:, None]) @ coefficients)
    return largest * ((largest + SOFT) / (1 + SOFT)) ** (power - 1)


def errors(found, measured, kinds):
    """The median error of each kind, as a factor."""
    error = np.abs(np.log2(found / measured))
    return {kind: 2 ** np.median(error[kinds == kind]) for kind in sorted(set(kinds))}


def main(folder):
    """Prints coefficients and errors."""
    kinds, nm, spectra = read(folder)
    rgb = linear_srgb(nm, spectra)
    seen = np.arange(len(kinds)) % 2 == 0
    columns = []
    for low, high in BANDS:
        measured = spectra[:, (nm >= low) & (nm <= high)].mean(1)

        def cost(coefficients):
            error = np.log2(fitted(coefficients, rgb) / measured)
            error = np.sqrt(error * error + 0.01)
            return np.mean([error[seen & (kinds == kind)].mean() for kind in set(kinds)])

        start = minimize(cost, [1, 0, 1], method="Nelder-Mead", options={"maxiter": 5000, "xatol": 1e-4})
        coefficients = np.round(start.x, 2)
        fit = errors(fitted(coefficients, rgb)[~seen], measured[~seen], kinds[~seen])
        largest = errors(rgb.max(1)[~seen], measured[~seen], kinds[~seen])
        print(f"{low}-{high} nm: {coefficients}, error {np.median(list(fit.values())):.2f}", end="")
        print(f" (largest channel alone: {np.median(list(largest.values())):.2f})")
        columns.append(fit)
    for kind in columns[0]:
        print(f"| {kind.replace('_', ' ')} | {(kinds == kind).sum()} |", " | ".join(f"{of[kind]:.2f}" for of in columns), "|")


if __name__ == "__main__":
    main(sys.argv[1])
