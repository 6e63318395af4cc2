#!/usr/bin/env python3
"""Prints cells.csv: what the names of the scenes beside it stand for."""
import math
import pathlib

EXTENT = {  # D [m], in 2D and 3D
    "L": (1.41, 1.47), "box": (1.41, 1.73), "stick": (2.01, 2.02), "plate": (1.61, 2.27),
    "triangle": (1.3, 1.35), "disc": (1.5, 1.5), "ring": (1.0, 1.03), "bunny": (1.3, 1.5)}

print("scene,dimension,friction,shape,rate_per_s,ground,gravity,D_m,slope_deg,inside_half_width_m,inside_above_m")
for file in sorted((pathlib.Path(__file__).parent / "scenes").glob("*.toml")):
    dimension, friction, shape, pour, ground, gravity = file.stem.split("-")
    extent = EXTENT[shape][dimension == "3d"]
    slope = 0.7 * math.atan(float(friction[1:])) if ground == "slope" else 0.0
    half_width = above = ""
    if ground == "slope":
        half_width = f"{0.49 * 60 * extent * math.cos(slope):.4g}"
    elif ground == "bin":
        half_width = f"{(10.0 if dimension == '2d' else 4.5) * extent / 2:.4g}"
    elif ground == "hopper":
        above = f"{2.5 * extent:.4g}"
    rate = pour[1:] if pour.startswith("r") else "inf"
    print(file.stem, dimension[0], friction[1:], shape, rate, ground, gravity[1:], extent,
          f"{math.degrees(slope):.4g}", half_width, above, sep=",")
