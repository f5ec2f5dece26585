#!/usr/bin/env python3
"""Writes ../spectra/brightener.csv, the bispectral matrix of a paper's brightener, made up by a formula: the bells of about a stilbene,
excited around 370 nm, of which it absorbs 45 %, and emitting around 437 nm, photon for photon 0.85; no light of a
shorter wavelength than is absorbed. The paper itself, brightened-paper.csv, absorbs as much around 370 nm."""
import math
import pathlib

SPECTRA = pathlib.Path(__file__).resolve().parent.parent / "spectra"
EXCITATION, EMISSION = range(300, 435, 5), range(400, 581, 5)
YIELD = 0.85


def absorbed(nm: float) -> float:
    return 0.45 * math.exp(-(((nm - 370) / 24) ** 2) / 2)


def emitted(nm: float) -> float:
    return math.exp(-(((nm - 437) / (17 if nm < 437 else 34)) ** 2) / 2)


def main() -> None:
    photons = sum(emitted(nm) * nm for nm in EMISSION) * EMISSION.step
    rows = [["excitation nm \\ emission nm", *EMISSION]]
    for mu in EXCITATION:
        rows.append([mu, *(f"{YIELD * absorbed(mu) * mu * emitted(nm) / photons if nm >= mu else 0:.6g}"
                           for nm in EMISSION)])
    (SPECTRA / "brightener.csv").write_text("# made up: make/paper.py\n" +
                                         "".join(",".join(map(str, row)) + "\n" for row in rows))
    base = {nm: 0.86 - 0.5 * math.exp(-max(0, nm - 300) / 60) for nm in range(300, 781, 5)}
    for name, share in (("brightened-paper", 1), ("plain-paper", 0)):
        lines = [f"{nm},{max(0.02, white * (1 - share * absorbed(nm) * 1.6)):.4f}\n" for nm, white in base.items()]
        (SPECTRA / f"{name}.csv").write_text("# made up: make/paper.py\nnm,reflectance\n" + "".join(lines))
    lamp = [f"{nm},{math.exp(-(((nm - 368) / 8) ** 2) / 2) + 4e-4 * math.exp(-(((nm - 405) / 4) ** 2) / 2):.6g}\n"
            for nm in range(330, 431)]
    (SPECTRA / "black-light.csv").write_text("# made up: make/paper.py\nnm,power\n" + "".join(lamp))


if __name__ == "__main__":
    main()
