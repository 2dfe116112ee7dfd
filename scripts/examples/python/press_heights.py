"""Press a height map against a rigid plane at three loads."""

import numpy as np

import roughfilm as rf

wave = np.cos(2 * np.pi * np.arange(128) / 128)
heights = 1e-6 * np.add.outer(wave, wave)
for load in (1e6, 1e7, 1e8):
    contact = rf.press(heights, spacing=2e-6, modulus=210e9, poisson=0.3, load=load, hardness=5e9)
    print(f"{load:8.0e} Pa: contact {contact.area_fraction:.2%}, mean gap {1e6 * contact.mean_gap:.3f} µm")
