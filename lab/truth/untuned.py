#!/usr/bin/env python3
"""Writes scenes that no value was tuned on: shapes, pours and grounds that the 60 scenes beside this script lack, with
friction, gravity, restitution, rate and number of bodies drawn at random.

  lab/truth/untuned.py FOLDER [--scenes 30] [--seed 1]
"""
import argparse
import math
import pathlib
import random

# Tables of shapes, and the greatest extent of a body [m]. Round ones resist rolling, or no heap of them comes to rest.
SHAPES_2D = {
    "hexagon": ("{kind = 'hull', corners = [[0.7, 0], [0.35, 0.6], [-0.35, 0.6], [-0.7, 0], [-0.35, -0.6], [0.35, -0.6]]}", 1.4),
    "capsule": ("{kind = 'capsule', length = 1.8, radius = 0.3, rolling_friction = 0.1}", 1.8),
    "stone": ("{kind = 'stone', size = 1.1, roughness = 0.4}", 1.8),
    "ellipse": ("{kind = 'ellipse', size = [1.6, 0.8], rolling_friction = 0.05}", 1.6),
    "cross": ("{kind = 'polygon', corners = [[0.2, 0.2], [0.2, 0.7], [-0.2, 0.7], [-0.2, 0.2], [-0.7, 0.2], [-0.7, -0.2], "
              "[-0.2, -0.2], [-0.2, -0.7], [0.2, -0.7], [0.2, -0.2], [0.7, -0.2], [0.7, 0.2]]}", 1.46)}
SHAPES_3D = {
    "tin": ("{kind = 'cylinder', length = 1.2, radius = 0.5, rolling_friction = 0.05}", 1.6),
    "capsule": ("{kind = 'capsule', length = 1.8, radius = 0.3, rolling_friction = 0.1}", 1.8),
    "stone": ("{kind = 'stone', size = 1.1, roughness = 0.4}", 1.8),
    "cone": ("{kind = 'cone', height = 1.2, radius = 0.6, rolling_friction = 0.05}", 1.7),
    "slab": ("{kind = 'box', size = [1.4, 0.7, 0.35]}", 1.6)}
POURS = ("spout", "rain", "sweep", "sizes", "thrown")
GROUNDS = ("flat", "bumps", "trough", "step", "shelf")


def obstacles(ground, friction, plane):
    """Tables of the obstacles of a ground, which reach from y = -5 to 5 in space."""
    def box(x, z, width, height, angle=0):
        size, at = ([width, height], [x, z]) if plane else ([width, 10, height], [x, 0, z])
        turn = "" if angle == 0 else f"angle_deg = {angle}\n" if plane else f"angle_deg = {-angle}\naxis = [0, 1, 0]\n"
        return f"[[obstacle]]\nkind = 'box'\nsize = {size}\nposition = {at}\n{turn}friction = {friction:.3f}\n"
    if ground == "bumps":
        return "\n".join(box(2.5 * i, 0, 0.8, 0.8, 45) for i in range(-10, 11))
    if ground == "trough":
        return box(-5, 2.5, 14, 0.6, -25) + "\n" + box(5, 2.5, 14, 0.6, 25)
    if ground == "step":
        return box(5, 1.25, 10, 2.5)
    if ground == "shelf":
        return box(0, 3.0, 7, 0.5)
    return ""


def scene(draw, number, dimension):
    """Name and text of a scene. Shapes, pours and grounds take turns, so that each occurs equally often."""
    plane = dimension == 2
    shapes = SHAPES_2D if plane else SHAPES_3D
    shape = list(shapes)[number % 5]
    pour = POURS[(number + number // 5) % 5]
    ground = GROUNDS[(number + 2 * (number // 5)) % 5]
    table, extent = shapes[shape]
    friction = math.exp(draw.uniform(math.log(0.12), math.log(1.2)))
    ground_friction = friction * draw.uniform(0.7, 1.3)
    gravity = math.exp(draw.uniform(math.log(1.3), math.log(30)))
    rate = math.exp(draw.uniform(math.log(1), math.log(30)))
    count = draw.randint(80, 300)
    restitution = draw.choice((0, 0, 0.1, 0.3))
    height = draw.uniform(4, 9) * extent
    speed = math.sqrt(2 * gravity * height)
    largest = extent * (1.5 if pour == "sizes" else 1.0)
    # As many spouts side by side as clear the place of the next body in time.
    columns = max(1, math.ceil(rate * 2.2 * largest / speed)) if pour != "rain" else 8
    # Of the highest point of the ground.
    above = 3.0 if ground == "shelf" else 2.5 if ground == "step" else 6.0 if ground == "trough" else 0.0
    across = 0.0
    source = [f"count = {count}", f"rate = {rate:.3f}"]
    if columns > 1:
        source += [f"grid = {[columns, 1] if plane else [columns, 1, 1]}",
                   f"spacing = {[1.1 * largest, 0] if plane else [1.1 * largest, 0, 0]}"]
    if pour == "sweep":
        source += [f"sweep = {[5, 0] if plane else [4, 0, 0]}", f"sweep_period = {draw.uniform(5, 20):.2f}"]
    if pour == "sizes":
        source += ["scale = {uniform = [0.7, 1.5]}"]
    if pour == "thrown":
        across = 0.4 * speed
        source += ["spin_spread = 3"]
    place, velocity = ([0, height + above], [across, -speed]) if plane else ([0, 0, height + above], [across, 0, -speed])
    source += [f"position = {place}", f"velocity = {velocity}", f"ride_above = {height}"]
    seconds = count / rate + 18 * math.sqrt(9.81 / gravity)
    name = f"{dimension}d-{number:02}-{shape}-{pour}-{ground}"
    text = (f"title = '{name}'\ndimension = {dimension}\nworld.gravity = {gravity:.3f}\nground.friction = {ground_friction:.3f}\n\n"
            f"{obstacles(ground, ground_friction, plane)}\n"
            f"[shape]\nbody = {table[:-1]}, friction = {friction:.3f}, restitution = {restitution}}}\n\n"
            "[[source]]\n" + "\n".join(source) + f"\n\n[run]\nframes = {math.ceil(30 * seconds)}\n")
    return name, text.replace("'", '"')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scenes", type=int, default=30, help="of each dimension")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for dimension in (2, 3):
        draw = random.Random(f"{options.seed} {dimension}")
        for number in range(options.scenes):
            name, text = scene(draw, number, dimension)
            (options.folder / f"{name}.toml").write_text(text)


if __name__ == "__main__":
    main()
