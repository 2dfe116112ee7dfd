"""Small scenes, as texts of files, that commands solve in a moment."""

SURFACE = """
kind = "self_affine"
size = ["40 um", "40 um"]
points = [32, 32]
seed = 20071
hurst = 0.8
roll_off = "20 um"
cut_off = "10 um"
rms_height = "0.1 um"
"""
"""The file rough.toml of the scenes below."""

SEEDS = SURFACE + 'amplitudes = "random"\n'
"""The surface with a spectrum that varies from seed to seed."""

CONTACT = """
name = "small contact"
kind = "dry_contact"
[geometry]
surface = "rough.toml"
[solid]
modulus = "10 MPa"
poisson = 0.5
[load]
pressure = "10 kPa"
"""

SEAL = """
name = "small seal"
kind = "seal"
[geometry]
surface = "rough.toml"
[solid]
modulus = "10 MPa"
poisson = 0.5
[load]
pressure = "10 kPa"
[liquid]
density = "1000 kg/m^3"
viscosity = "1 mPa*s"
[flow]
pressure_drop = "1 MPa"
length = "1 mm"
direction = "y"
"""
