"""Preconditioner: the flow of small disturbances of shear between parallel walls, by Fourier transforms."""

import numpy as np
import scipy.fft

from roughfilm.rom.pocket.basis import STIFFNESS


class Parallel:
    def __init__(self, sheet, basis, re, h):
        (nx, ny), n = sheet.thickness.shape[1:], len(basis.shape)
        dx, dy = sheet.rows[0][0].mean(), sheet.rows[1][0].mean()
        self.h, self.dx, self.dy, self.shape, self.sheet = h, dx, dy, (nx, ny), sheet
        ex = np.exp(2j * np.pi * np.fft.fftfreq(nx))
        ey = np.exp(2j * np.pi * np.arange(ny // 2 + 1) / ny)
        w, phi, prim, slope, Y = basis.weights, basis.shape, basis.primitive, basis.slope, basis.nodes
        k_uu = (phi * w * Y) @ phi.T          # test k, amplitude l
        k_rise = (slope * w * Y) @ prim.T
        second = sheet.rows[0][2].mean() > 0
        rec = (1.5 - 0.5 / ex if second else 1 + 0 / ex)[:, None, None]
        from roughfilm.rom.pocket.plan.film import equations
        rec = equations.CENTRAL * ((1 + 1 / ex) / 2)[:, None, None] * ex[:, None, None] + (1 - equations.CENTRAL) * rec
        X = ex[:, None, None]
        unit = np.eye(n) * STIFFNESS / h
        au = re * h / dx * (2 * k_uu * rec * (1 - 1 / X) + k_rise * (X - 1 / X) / 2) + unit
        av = re * h / dx * k_uu * rec * (1 - 1 / X) + unit
        c = re * h * (k_uu + k_rise) * (1 + X) / 2
        f = basis.flow * h
        self.iu, self.iv = np.linalg.inv(au), np.linalg.inv(av)
        self.c = self.iu @ c
        self.gx, self.gy = f * (ex - 1)[:, None] / dx, f * (ey - 1) / dy
        self.dxs, self.dys = f * (1 - 1 / ex)[:, None] / dx, f * (1 - 1 / ey) / dy
        self.gamma = (1 - 1 / ey) / dy
        self.kappa = (self.c @ self.iv)[:, 0, 0][:, None]
        alpha_u, alpha_v = self.iu[:, 0, 0][:, None], self.iv[:, 0, 0][:, None]
        s = self.dxs * (self.gamma * self.gy * self.kappa - self.gx * alpha_u) - self.dys * self.gy * alpha_v
        s[0, 0] = 1
        self.inverse = 1 / s
        self.inverse[0, 0] = 0

    def __call__(self, ra, rb, rp):
        s = self.sheet
        ra = scipy.fft.rfft2((ra / s.area_u[:, :, None]), axes=(1, 0)[::-1])
        rb = scipy.fft.rfft2((rb / s.area_v[:, :, None]), axes=(0, 1))
        rp = scipy.fft.rfft2(rp / s.area_p)
        # (nx, nky, n)
        vb = rb @ self.iv.transpose(0, 2, 1)
        ua = ra @ self.iu.transpose(0, 2, 1) - self.gamma[:, None] * (vb @ self.c.transpose(0, 2, 1))
        p = (rp - self.dxs * ua[:, :, 0] - self.dys * vb[:, :, 0]) * self.inverse
        ivp = self.iv[:, :, 0]
        dv = (self.gy * p)[:, :, None] * ivp[:, None, :]
        vb = vb - dv
        ua = ua + self.gamma[:, None] * (dv @ self.c.transpose(0, 2, 1)) - (self.gx * p)[:, :, None] * self.iu[:, None, :, 0]
        back = lambda q: scipy.fft.irfft2(q, s=self.shape, axes=(0, 1))
        hu, hv = s.thickness[:2]
        return back(ua), back(vb), back(p)
