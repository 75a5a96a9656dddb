"""Rates and frequencies of a small motion, from a record of it."""

import numpy as np


def leading_mode(signals, step, tolerance=1e-6):
    """Rate and frequency of the strongest mode at the end of a record: dynamic mode decomposition of complex signals
    (rows: places, columns: times). Rows that follow a sum of exponentials give them to the precision of the record."""
    before, after = signals[:, :-1], signals[:, 1:]
    places, sizes, times = np.linalg.svd(before, full_matrices=False)
    kept = sizes > tolerance * sizes[0]
    places, sizes, times = places[:, kept], sizes[kept], times[kept]
    factors, shapes = np.linalg.eig(places.conj().T @ after @ times.conj().T / sizes)
    strengths = np.linalg.lstsq(places @ shapes, signals[:, -1], rcond=None)[0]
    strengths = np.abs(strengths) * np.linalg.norm(places @ shapes, axis=0)
    rate = np.log(factors[np.argmax(strengths)]) / step
    return rate.real, abs(rate.imag)
