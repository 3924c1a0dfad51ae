# A navigated screw in four steps, as a notebook: each `# %%` begins a cell (VS Code, Spyder and Jupytext
# show them so). From a shell:
#   orthonav run --headset 'sim:?seed=3' --levels L4 --frames 60 --record RECORDING
#   python3 navigate.py RECORDING
# Metres and radians throughout; a matrix named a_from_b takes coordinates in b to coordinates in a.

# %% What there is
import json
import os
import sys

import numpy as np
import orthonav

folder = sys.argv[1]
tools = orthonav.load_tools(os.path.join(folder, "tools.json"))
level = orthonav.phantom(["L4"])[0]
left_screw, right_screw = level.screws

# %% Track: the tools in every stereo pair
recording = orthonav.Recording(folder)
tracker = orthonav.Tracker(recording.rig, tools)
tracked = [(pair.time_s, tracker.track(pair.left, pair.right, pair.time_s, pair.world_from_rig))
           for pair in recording]
for k, tool in enumerate(tools):
    measured = [states[k] for _, states in tracked if states[k].status == "measured"]
    print(f"{tool.name}: measured in {len(measured)} of {len(tracked)} pairs")
    last = measured[-1] if measured else None
    if last is not None and last.covariance is not None and last.world_from_marker is not None:
        sd_m = np.sqrt(np.trace(last.covariance[:3, :3]))
        print(f"  last at {last.world_from_marker[:3, 3].round(3)}, SD {1e3 * sd_m:.2f} mm")

# %% Register: points on the bone, here drawn from the model itself with the noise of a pointer
model = orthonav.VertebraModel(level.vertices, level.triangles)
vertices, triangles = model.reachable
middles = vertices[triangles].mean(axis=1)
random = np.random.default_rng(seed=1)
points_in_vertebra = middles[random.choice(len(middles), size=600, replace=False)]
turn = np.radians(30)
true_world_from_vertebra = np.array([[np.cos(turn), -np.sin(turn), 0, 0.1],
                                     [np.sin(turn), np.cos(turn), 0, 0.2],
                                     [0, 0, 1, -0.3],
                                     [0, 0, 0, 1]])
points = points_in_vertebra @ true_world_from_vertebra[:3, :3].T + true_world_from_vertebra[:3, 3]
points += random.normal(scale=0.0002, size=points.shape)
registration = orthonav.register(model, points, level.screws)
print("accepted" if registration.accepted else f"refused: {registration.reasons}",
      f"error to expect {1e3 * registration.predicted_error_m:.2f} mm")

# A plane tells nothing about where on it the bone lies: that is said, not guessed.
plane = np.column_stack([random.uniform(-0.03, 0.03, (300, 2)), np.zeros(300)])
of_a_plane = orthonav.register(model, plane, level.screws)
print("a plane:", "accepted" if of_a_plane.accepted else f"refused: {'; '.join(of_a_plane.reasons)}")

# %% Guide: a drill guide 5 degrees off the plan, 2 mm before the entry
guide = next(tool for tool in tools if tool.role == "guide")
outward = left_screw.entry - left_screw.target
outward /= np.linalg.norm(outward)
across = np.cross(outward, [0, 0, 1])
across /= np.linalg.norm(across)
off = np.radians(5)
axis = np.cos(off) * outward + np.sin(off) * across
tip = left_screw.entry + 0.002 * outward


def world_from_marker(tip_in_vertebra, axis_in_vertebra):
    """Where the guide's tag is when its tip and axis are there; the tool may turn about its axis."""
    def basis(direction):
        first = np.cross(direction, [0.3, 0.5, 0.8])
        first /= np.linalg.norm(first)
        return np.column_stack([direction, first, np.cross(direction, first)])
    vertebra_from_marker = np.eye(4)
    vertebra_from_marker[:3, :3] = basis(axis_in_vertebra) @ basis(guide.axis_in_marker).T
    vertebra_from_marker[:3, 3] = (tip_in_vertebra
                                   - vertebra_from_marker[:3, :3] @ guide.tip_in_marker)
    return registration.world_from_vertebra @ vertebra_from_marker


told = orthonav.guide(model, left_screw, registration, guide, world_from_marker(tip, axis))
print(f"{np.degrees(told.angle_rad):.1f} deg off, tip {1e3 * told.tip_off_axis_m:.1f} mm beside the axis, "
      f"{1e3 * told.depth_m:.1f} mm past the entry")
if told.clearance_m is not None and told.clearance_95_m is not None:
    print(f"clearance {1e3 * told.clearance_m:.1f} mm (95 %: {1e3 * told.clearance_95_m:.1f} mm), grade {told.grade}")
on_plan = orthonav.guide(model, left_screw, registration, guide,
                         world_from_marker(left_screw.entry, outward))

# %% Render: the planned screw as a headset shows it, into an array
scene = {
    "format": "orthonav-scene", "version": 1,
    "view": {"eye_mm": [60, 320, 60], "target_mm": list(1e3 * left_screw.entry), "up": [0, 0, 1],
             "width_px": 320, "height_px": 240, "width_deg": 20},
    "holograms": [
        {"type": "trajectory", "entry_mm": list(1e3 * left_screw.entry),
         "target_mm": list(1e3 * left_screw.target)},
        {"type": "triangle", "entry_mm": list(1e3 * left_screw.entry),
         "tool_mm": list(1e3 * (tip + 0.08 * axis)),
         "plan_mm": list(1e3 * (left_screw.entry + 0.08 * outward)),
         "angle_deg": float(np.degrees(told.angle_rad))},
    ],
}
picture = orthonav.render_text(json.dumps(scene))
print(f"drawn: {picture.shape}, {np.count_nonzero(picture[..., :3].any(axis=-1))} pixels shine")
