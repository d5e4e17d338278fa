"""The reflectance of a colour, (P20), against measured surfaces.

    pip install numpy scipy colour-science && pip download --no-deps earthlib==1.1.0
    unzip earthlib-*.whl && python reflectance.py earthlib/data          # prints errors
    python reflectance.py earthlib/data --table measured.csv             # colours for the tests

The data are those of infrared.py: 400 to 2450 nm, held constant outside. Every other spectrum of a kind was
used to find numbers; errors and colours are those of the others.

How the numbers were found. The form (least squared steps with a roughness, bounds, and foliage) was chosen
among about 25 by comparing the errors of both halves. LN_ROUGHNESS and RISE: Nelder-Mead, for small mean
errors of the kinds but for canopies at D from 1.05 to 1.5, and few neighbours more than 5 apart; the eighth
roughness, 6.27, was set to 6. The first of BANDS: infrared.py; the others, and WHITE: Nelder-Mead, for small
errors of the bands as in infrared.py and neighbours less than 5.5 apart at D from 1.73 to 5. LEAST: as few
neighbours more than 6 apart as possible, which changes no error of a kind by 0.1. CENTRE, RADII
and RED_EDGE: chosen by hand among a few. FOLIAGE: means of simulated canopies.
"""

import sys

import colour
import infrared
import numpy as np

DOPPLER = [1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4, 1.5, 1.73, 2.0, 2.5]
NEIGHBOURS = [0.6, 0.7, 0.8, 0.9, *DOPPLER, 3.0, 4.0, 5.0]

# The parameters of crates/ugphysics/src/spectrum: curve.rs, infrared.rs, foliage.rs.
LN_ROUGHNESS = [-0.86, 5.36, -1.62, -1.02, -3.48, -0.84, -2.93, 6.0, 0.0]
RISE, RED_EDGE, SOFT = 8.3, (690.0, 750.0), 0.02
BANDS = np.array([[0.9, -1.06, 1.2], [1.28, 0.05, 1.88], [0.03, -0.05, 2.14], [0.06, 1.85, 0.63]])
WHITE = np.array([0.005, 0.175, 0.175, 0.175])
DARK, LEAST = 0.03, 9.0
LEVELS_NM = np.array([845.0, 1150.0, 1640.0, 2200.0])
CENTRE, RADII = np.array([30.0, -14.0, 26.0]), np.array([30.0, 22.0, 24.0])
FOLIAGE = np.array([0.43, 0.39, 0.17, 0.06])

GRID = np.concatenate([np.arange(220, 780, 5.0), np.arange(780, 4200, 10.0)])
CURVE = (GRID >= 380) & (GRID <= 780)
NM = GRID[CURVE]


def daylight(nm):
    """D65, continued by Planck's law at 6504 K."""
    d65, at = colour.SDS_ILLUMINANTS["D65"], np.arange(380, 781, 5.0)
    values = np.array([d65[nm] for nm in at]) / 100
    planck = lambda nm: nm**-5.0 / np.expm1(1.4387768775e7 / (nm * 6504))
    below, above = planck(nm) / planck(380.0) * values[0], planck(nm) / planck(780.0) * values[-1]
    return np.where(nm < 380, below, np.where(nm > 780, above, np.interp(nm, at, values)))


def weights(doppler):
    """X, Y, Z of a reflectance that is 1 at a point of the grid and falls to 0 at the next."""
    seen, shape = np.arange(360, 831.0), colour.SpectralShape(360, 830, 1)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values
    nm = seen * doppler
    light = observer * daylight(nm)[:, None] / (daylight(seen) @ observer[:, 1])
    nm = np.clip(nm, GRID[0], GRID[-1])
    row = np.clip(np.searchsorted(GRID, nm) - 1, 0, len(GRID) - 2)
    part = ((nm - GRID[row]) / (GRID[row + 1] - GRID[row]))[:, None]
    sums = np.zeros((len(GRID), 3))
    np.add.at(sums, row, light * (1 - part))
    np.add.at(sums, row + 1, light * part)
    return sums


SEEN = {doppler: weights(doppler) for doppler in [1.0, *NEIGHBOURS]}
WHITE_XYZ = SEEN[1.0].sum(0)
PRIMARIES = np.array([[x / y, 1, (1 - x - y) / y] for x, y in [(0.64, 0.33), (0.3, 0.6), (0.15, 0.06)]]).T
TO_XYZ = PRIMARIES * np.linalg.solve(PRIMARIES, WHITE_XYZ)
RGB = SEEN[1.0] @ np.linalg.inv(TO_XYZ).T
INSIDE = RGB[CURVE].copy()
INSIDE[0] += RGB[GRID < 380].sum(0)


def lab(xyz, white):
    """CIELAB."""
    part = xyz / white
    root = np.where(part > 216 / 24389, np.cbrt(part), part / (3 * 36 / 841) + 4 / 29)
    x, y, z = np.moveaxis(root, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def seen_lab(reflectance, doppler):
    """CIELAB of reflectances, with white seen with the same D as white."""
    return lab(reflectance @ SEEN[doppler], SEEN[doppler].sum(0))


def smooth_step(x):
    """From 0 to 1."""
    x = np.clip(x, 0, 1)
    return x**3 * (10 + x * (6 * x - 15))


def levels(rgb, bands=BANDS, white=WHITE):
    """The reflectances of the infrared bands, and how much a colour counts as foliage."""
    most = rgb.max(1)[:, None]
    lacks = (most - rgb)[:, None, :] / (most + white)[:, :, None]
    sums = (lacks * bands).sum(2)
    power = 2.0 ** -np.where(sums < 0, sums / np.hypot(1, LEAST * sums), sums)
    found = np.where(most < 1, most * ((most + DARK) / (1 + DARK)) ** (power - 1), most)
    away = ((lab(rgb @ TO_XYZ.T, WHITE_XYZ) - CENTRE) / RADII) ** 2
    share = np.where(most < 1, np.maximum(1 - away.sum(1), 0)[:, None] ** 2, 0)
    return found + share * (FOLIAGE - found), share


def shares():
    """The share of each band at the wavelengths of the grid beyond 780 nm."""
    ln, at = np.log(GRID[GRID > 780]), np.log(LEVELS_NM)
    found = np.zeros((4, len(ln)))
    found[0] = 1
    for band in (1, 2, 3):
        step = smooth_step((ln - at[band - 1]) / (at[band] - at[band - 1]))
        found[band] = found[band - 1] * step
        found[band - 1] *= 1 - step
    return found


def functions():
    """The smoothest changes of a curve by which one channel is 1 and the others are 0."""
    middle = (NM[1:] + NM[:-1]) / 2
    roughness = np.exp(np.interp(middle, np.arange(380, 781, 50), LN_ROUGHNESS))
    steps = np.cumsum(INSIDE, 0)[:-1] / roughness[:, None]
    found = np.zeros((3, len(NM)))
    found[:, :-1] = np.cumsum(steps[::-1], 0)[::-1].T
    return np.linalg.solve(found @ INSIDE, found)


def bounded(x, most):
    """x held softly between 0 and a bound; and its derivative."""
    low, high = np.hypot(x, SOFT), np.hypot(x - most, SOFT)
    return (most + low - high) / 2, (x / low - (x - most) / high) / 2


def unbounded(value, most):
    """The inverse."""
    return most / 2 + (value - most / 2) * np.sqrt(1 + SOFT**2 / (value * (most - value)))


def reflectance(rgb):
    """(P20) of linear red, green and blue, on the grid; and the largest error at rest."""
    basis, infrared_shares = functions(), shares()
    level, foliage = levels(rgb)
    most = rgb.max(1)[:, None]
    bound = np.clip(1 / most, 1.02, 100)
    ends = unbounded(np.ones_like(bound), bound), unbounded(level[:, :1] / most, bound)
    way = (NM - 380) / 400
    shape = way**RISE + foliage * (smooth_step((NM - RED_EDGE[0]) / (RED_EDGE[1] - RED_EDGE[0])) - way**RISE)
    start = ends[0] + (ends[1] - ends[0]) * shape
    target = (rgb - (level @ infrared_shares) @ RGB[GRID > 780]) / most
    amounts, damping = np.zeros_like(rgb), np.full(len(rgb), 1e-6)

    def error(amounts, rows):
        value, slope = bounded(start[rows] + amounts @ basis, bound[rows])
        return value, value @ INSIDE - target[rows], np.stack([(slope * row) @ INSIDE for row in basis], -1)

    value, off, slopes = error(amounts, np.arange(len(rgb)))
    for _ in range(80):
        rows = np.flatnonzero(abs(off).max(1) > 1e-9)
        if len(rows) == 0:
            break
        square = np.einsum("nck,ncl->nkl", slopes[rows], slopes[rows])
        diagonal = np.einsum("nkk->nk", square)[:, :, None] * np.eye(3)
        right = np.einsum("nck,nc->nk", slopes[rows], off[rows])[..., None]
        step = -np.linalg.solve(square + damping[rows][:, None, None] * diagonal + 1e-15 * np.eye(3), right)[..., 0]
        new_value, new_off, new_slopes = error(amounts[rows] + step, rows)
        better = (new_off**2).sum(1) < (off[rows] ** 2).sum(1)
        damping[rows] = np.where(better, damping[rows] / 10, np.maximum(damping[rows] * 10, 1e-12))
        rows = rows[better]
        amounts[rows] += step[better]
        value[rows], off[rows], slopes[rows] = new_value[better], new_off[better], new_slopes[better]
    found = np.empty((len(rgb), len(GRID)))
    found[:, CURVE] = most * value
    found[:, GRID < 380] = found[:, CURVE][:, :1]
    found[:, GRID > 780] = level @ infrared_shares
    return found, abs(off).max()


def pairs(n, seed=1):
    """Random pairs of colours of a screen that differ by at most 3 at rest."""
    random, found = np.random.default_rng(seed), []
    while sum(map(len, found)) < n:
        code = random.random((n, 3))
        first = np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
        way = random.normal(size=(n, 3))
        way *= 3 * random.random((n, 1)) ** (1 / 3) / np.linalg.norm(way, axis=1)[:, None]
        x, y, z = (lab(first @ TO_XYZ.T, WHITE_XYZ) + way).T
        y, a, b = (x + 16) / 116, y / 500, z / 200
        root = np.stack([y + a, y, y - b], 1)
        part = np.where(root > 6 / 29, root**3, 3 * 36 / 841 * (root - 4 / 29))
        second = part * WHITE_XYZ @ np.linalg.inv(TO_XYZ).T
        valid = (second.min(1) >= 0) & (second.max(1) <= 1) & (first.max(1) < 1)
        found.append(np.stack([first[valid], second[valid]]).transpose(1, 0, 2))
    return np.concatenate(found)[:n].transpose(1, 0, 2)


def neighbours(colors):
    """The differences of pairs in motion, by D."""
    first, second = (reflectance(rgb)[0] for rgb in colors)
    return np.array([np.linalg.norm(seen_lab(first, d) - seen_lab(second, d), axis=1) for d in NEIGHBOURS])


def errors(kinds, spectra, found, chosen, doppler):
    """The mean difference of each kind at each D."""
    off = np.stack([np.linalg.norm(seen_lab(found, d) - seen_lab(spectra, d), axis=1) for d in doppler], 1)
    return {kind: off[chosen & (kinds == kind)].mean(0) for kind in sorted(set(kinds))}


def classes(spectra, rgb, found, chosen):
    """The differences below which 10 % and 90 % of greys, foliage and others are, by D."""
    _, a, b = lab(rgb @ TO_XYZ.T, WHITE_XYZ).T
    is_foliage = levels(rgb)[1][:, 0] > 0
    is_grey = (np.hypot(a, b) < 10) & ~is_foliage
    rows = {"grey": is_grey, "foliage": is_foliage, "saturated": ~is_grey & ~is_foliage}
    doppler = [1.05, 1.1, 1.2, 1.3, 1.5, 2.0, 2.5]
    off = np.stack([np.linalg.norm(seen_lab(found, d) - seen_lab(spectra, d), axis=1) for d in doppler], 1)
    print("| class | spectra |", " | ".join(map(str, doppler)), "|")
    for name, row in rows.items():
        low, high = np.percentile(off[chosen & row], [10, 90], axis=0)
        print(f"| {name} | {(chosen & row).sum()} |", " | ".join(f"{a:.1f}–{b:.1f}" for a, b in zip(low, high)), "|")


def main(folder, *options):
    """Prints errors and neighbours, or writes the table of colours."""
    kinds, nm, spectra = infrared.read(folder)
    spectra = np.array([np.interp(GRID, nm, spectrum) for spectrum in spectra])
    rgb = spectra @ RGB
    kept = rgb.min(1) > 0
    kinds, spectra, rgb = kinds[kept], spectra[kept], rgb[kept]
    fitted = np.zeros(len(kinds), bool)
    for kind in set(kinds):
        fitted[np.flatnonzero(kinds == kind)[::2]] = True
    if options[:1] == ("--table",):
        with open(options[1], "w", encoding="utf-8") as file:
            print("kind,red,green,blue" + "".join(f",X{d},Y{d},Z{d}" for d in [1.05, 1.2, 1.3, 1.5]), file=file)
            for kind in sorted(set(kinds)):
                rows = np.flatnonzero(~fitted & (kinds == kind))
                for row in rows[np.linspace(0, len(rows) - 1, min(len(rows), 10)).astype(int)]:
                    seen = [spectra[row] @ SEEN[d] / SEEN[d].sum(0) for d in [1.05, 1.2, 1.3, 1.5]]
                    print(kind, *(f"{part:.5f}" for part in [*rgb[row], *np.concatenate(seen)]), sep=",", file=file)
        return None
    found, at_rest = reflectance(rgb)
    print(f"error at rest {at_rest:.0e}")
    means = errors(kinds, spectra, found, ~fitted, DOPPLER)
    print("| kind | spectra |", " | ".join(map(str, DOPPLER)), "|")
    for kind, row in means.items():
        count = (~fitted & (kinds == kind)).sum()
        print(f"| {kind.replace('_', ' ')} | {count} |", " | ".join(f"{part:.1f}" for part in row), "|")
    print("| mean | |", " | ".join(f"{part:.1f}" for part in np.mean(list(means.values()), 0)), "|")
    classes(spectra, rgb, found, ~fitted)
    for low, high in infrared.BANDS:
        band = (GRID >= low) & (GRID <= high)
        measured, name = spectra[~fitted][:, band].mean(1), f"{low}–{high} nm"
        factors = [
            np.median(list(infrared.errors(guess, measured, kinds[~fitted]).values()))
            for guess in (found[~fitted][:, band].mean(1), rgb[~fitted].max(1))
        ]
        print(f"| {name} | {factors[0]:.2f} | {factors[1]:.2f} |")
    apart = neighbours(pairs(20000))
    for doppler, row in zip(NEIGHBOURS, apart):
        print(f"D {doppler}: neighbours {row.max():.1f} apart, 99 % below {np.percentile(row, 99):.1f}")
    print(f"pairs with more than 6 at some D: {(apart.max(0) > 6).mean():.2%}")
    return None


if __name__ == "__main__":
    main(*sys.argv[1:])
