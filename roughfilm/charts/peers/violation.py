"""The violation of the conditions of contact by a pressure, in float64, with one measure for every solver."""

import numpy as np


def displacement(pressure, spacing):
    """Displacement into the periodic half-space, of mean 0: its transform is 2/|q| that of the pressure over E*."""
    nx, ny = pressure.shape
    qx = 2 * np.pi * np.fft.fftfreq(nx, spacing[0])[:, None]
    qy = 2 * np.pi * np.fft.rfftfreq(ny, spacing[1])[None, :]
    q = np.hypot(qx, qy)
    q[0, 0] = np.inf
    return np.fft.irfft2(np.fft.rfft2(pressure) * (2 / q), s=pressure.shape)


def judge(heights, pressure, *, spacing, load, hardness=np.inf):
    """Area and mean gap that follow from a pressure, and by how much it misses the conditions of contact.

    With g = h1 + K*p and the plane g00, the mean of g over 0 < p < H, the gap g - g00 is to be 0 where 0 < p < H,
    at least 0 where p = 0, and at most 0 where p = H, as the surface yields there and lies on the plane.
    Pressures, load and hardness are over E*, what comes out is over the rms height, the load error over the load.
    """
    rms = heights.std()
    gap = heights.max() - heights + displacement(pressure, spacing)
    free = pressure <= 0
    yields = pressure >= hardness
    elastic = ~free & ~yields
    gap -= gap[elastic].mean() if elastic.any() else gap[yields].max()
    missed = {
        "in_contact": np.abs(gap[elastic]).max(initial=0.0) / rms,
        "outside": np.maximum(0.0, -gap[free]).max(initial=0.0) / rms,
        "yielding": np.maximum(0.0, gap[yields]).max(initial=0.0) / rms,
    }
    gap[yields] = 0.0
    return {
        "area_fraction": float(np.mean(~free)),
        "plastic_fraction": float(np.mean(yields)),
        "mean_gap_over_rms": float(gap.mean() / rms),
        "violation": float(max(missed.values())),
        "violations": {name: float(value) for name, value in missed.items()},
        "below_zero": float(max(0.0, -pressure.min())),
        "above_hardness": float(max(0.0, pressure.max() - hardness)),
        "load_error": float(abs(pressure.mean() / load - 1)),
    }
