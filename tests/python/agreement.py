"""The notebook runs, and what it computes is what the command computes and what NumPy says.

    agreement.py COMMAND NOTEBOOK FOLDER       FOLDER is made anew
"""
import csv
import json
import os
import runpy
import shutil
import struct
import subprocess
import sys
import zlib

import numpy as np


def run(*command, fails=False):
    done = subprocess.run(command, capture_output=True, text=True)
    assert fails or done.returncode == 0, f"{command}: {done.stderr}"
    return done.stdout


def near(found, expected, tolerance, what):
    worst = np.max(np.abs(np.asarray(found) - np.asarray(expected)))
    assert worst <= tolerance, f"{what}: {found}, expected {expected} within {tolerance}"


def check_tracking(command, folder, notebook):
    """Each pose of the notebook is a row of `orthonav track`, and no row is left over."""
    rows = {}
    for row in csv.DictReader(run(command, "track", folder, "-t", os.path.join(folder, "tools.json"),
                                  "--csv", "-").splitlines()):
        rows[int(row["timestamp_100ns"]), int(row["id"])] = row
    assert len(rows) > 60, f"only {len(rows)} poses: the recording shows nothing"
    epoch = min(time for time, _ in rows) - round(1e7 * notebook["tracked"][0][0])
    for time_s, states in notebook["tracked"]:
        for tool, state in zip(notebook["tools"], states):
            key = round(1e7 * time_s) + epoch, tool.tag_id
            if state.status == "measured":
                compare_pose(state, rows.pop(key))
            else:
                assert key not in rows, f"{tool.name} is {state.status} at {time_s} s"
            assert (state.world_from_marker is None) == (state.status == "lost")
    assert not rows, f"the notebook lacks {list(rows)[:3]}"


def compare_pose(state, row):
    pose = state.world_from_marker
    near(pose[:3, 3], [float(row[k]) for k in ("px", "py", "pz")], 1e-9, "position")
    x, y, z, w = (float(row[k]) for k in ("qx", "qy", "qz", "qw"))
    near(pose[:3, 2], [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1e-9, "z axis")
    near(pose[:3, 0], [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], 1e-9, "x axis")
    sigma_mm = 1e3 * np.sqrt(np.trace(state.covariance[:3, :3]))
    near(sigma_mm, float(row["sigma_mm"]), 1e-5, "sigma")


def check_registration(command, folder, notebook):
    points = os.path.join(folder, "points.csv")
    np.savetxt(points, notebook["points"], delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    said = json.loads(run(command, "register", "--level", "L4", "--points", points, "--units", "m",
                          "--json", "-"))
    registration = notebook["registration"]
    assert registration.accepted and said["accepted"] and not registration.reasons
    near(registration.world_from_vertebra, said["model_to_points"], 1e-9, "pose")
    near(1e3 * registration.predicted_error_m, said["predicted_tre_mm"], 1e-9, "error to expect")
    screw = notebook["left_screw"].entry

    def place(pose):
        return pose[:3, :3] @ screw + pose[:3, 3]

    # Ten times the error that is expected there; the noise of the points is 0.2 mm.
    near(place(registration.world_from_vertebra), place(notebook["true_world_from_vertebra"]),
         10 * registration.screw_errors[0].entry_m, "the screw's entry")
    refused = notebook["of_a_plane"]
    assert not refused.accepted and refused.reasons


def check_guidance(command, notebook):
    told, screw = notebook["told"], notebook["left_screw"]
    tip, axis = notebook["tip"], notebook["axis"]
    inward = (screw.target - screw.entry) / np.linalg.norm(screw.target - screw.entry)
    near(told.angle_rad, np.arccos(np.clip(-inward @ axis, -1, 1)), 1e-9, "angle")
    near(told.depth_m, (tip - screw.entry) @ inward, 1e-9, "depth")
    near(told.tip_to_entry_m, np.linalg.norm(tip - screw.entry), 1e-9, "tip to entry")
    near(told.tip_off_axis_m, 0, 1e-9, "tip off the axis")
    near(told.to_target_m, (screw.target - tip) @ inward, 1e-9, "to the target")
    assert told.clearance_95_m < told.clearance_m < notebook["on_plan"].clearance_m
    near(told.tip_medial_m[0], 0, 1e-9, "tip medial")
    aim_rad = np.hypot(told.aim_cranial_rad[0], told.aim_medial_rad[0])
    near(aim_rad, told.angle_rad, 1e-3, "aim")
    checked = json.loads(run(command, "plan", "check", "--levels", "L4", "--json", "-"))
    planned = checked["levels"][0]["screws"][0]
    near(1e3 * notebook["on_plan"].clearance_m, planned["clearance_mm"], 0.1, "clearance on the plan")
    assert notebook["on_plan"].grade == planned["grade"]


def png(path):
    """The pixels of an RGBA picture of 8 bits (PNG specification, section 9.2)."""
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 6)
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 4 * width)
    picture = np.zeros((height + 1, 4 * width + 4), np.uint8)
    for y, row in enumerate(rows, start=1):
        assert row[0] <= 4
        for x in range(4, 4 * width + 4):
            left, up, corner = int(picture[y, x - 4]), int(picture[y - 1, x]), int(picture[y - 1, x - 4])
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up),
                        (abs(guess - corner), 2, corner))[2]
            predicted = (0, left, up, (left + up) // 2, paeth)[row[0]]
            picture[y, x] = (int(row[x - 3]) + predicted) & 255
    return picture[1:, 4:].reshape(height, width, 4)


def check_picture(command, folder, notebook):
    scene, out = os.path.join(folder, "scene.json"), os.path.join(folder, "scene.png")
    with open(scene, "w", encoding="utf-8") as file:
        json.dump(notebook["scene"], file)
    run(command, "render", scene, "-o", out)
    picture = notebook["picture"]
    assert picture.shape == (2, 240, 320, 4) and picture.dtype == np.uint8
    assert np.count_nonzero(picture[..., :3].any(axis=-1)) > 200, "nothing was drawn"
    assert np.array_equal(png(out), np.concatenate(list(picture), axis=1)), "not the command's picture"
    import orthonav
    assert np.array_equal(orthonav.render_file(scene), picture)


def main(command, script, folder):
    shutil.rmtree(folder, ignore_errors=True)
    # The operation of so few pairs ends before the workflow does: the command says so by its exit code.
    run(command, "run", "--headset", "sim:?seed=3", "--levels", "L4", "--frames", "60", "--record", folder,
        fails=True)
    sys.argv = [script, folder]
    notebook = runpy.run_path(script)
    check_tracking(command, folder, notebook)
    check_registration(command, folder, notebook)
    check_guidance(command, notebook)
    check_picture(command, folder, notebook)


main(*sys.argv[1:])
