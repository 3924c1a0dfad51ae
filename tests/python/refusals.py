"""What can't be used raises orthonav.Error, which names it; the same call with good values is answered."""
import numpy as np
import orthonav

level = orthonav.phantom(["L4"])[0]
model = orthonav.VertebraModel(level.vertices, level.triangles)
screw = level.screws[0]
guide = orthonav.built_in_tools()[1]
camera = orthonav.Camera.from_brown_conrady(64, 48, 45.0, 45.0, 32.0, 24.0)
beside = np.eye(4)
beside[0, 3] = -0.1
rig = orthonav.Rig(camera, camera, np.eye(4), beside)
grey = np.zeros((48, 64), np.uint8)
vertices, triangles = model.reachable
points = vertices[triangles].mean(axis=1)[::10]
scene = ('{"format": "orthonav-scene", "version": 1, "view": {"eye_mm": [0, 0, 300], "target_mm": [0, 0, 0],'
         ' "width_px": 32, "height_px": 24}, "holograms": [%s]}')


def refused(name, call, *arguments, **named):
    """`name` is what the message has to say."""
    try:
        call(*arguments, **named)
    except orthonav.Error as error:
        assert isinstance(error, ValueError)
        assert name in str(error) and "\n" not in str(error), f"says \"{error}\", not {name}"
        return
    raise AssertionError(f"{name} was taken: {call.__name__}{arguments}{named}")


def changed(array, value, *place):
    array = np.array(array, dtype=float)
    array[place] = value
    return array


# Arrays of another shape, of other numbers, with holes.
def register(points, **named):
    return orthonav.register(model, points, level.screws, **named)


assert register(points).accepted
refused("points: has shape (0,), must be (N, 3)", register, [])
refused("points: has shape", register, points.T)
refused("points: has shape", register, points[0])
refused("points: holds nan", register, changed(points, np.nan, 5, 1))
refused("points: holds inf", register, changed(points, np.inf, 5, 1))
refused("points: holds complex128", register, points.astype(complex))
refused("points: holds <U", register, [["a", "b", "c"]])
refused("points: ", register, "points")
refused("points: ", register, None)
refused("points: ", register, [[1, 2, 3], [1, 2]])
refused("points", register, points[:5])
refused("points", register, 1e200 * points)
refused("paper", register, points, method="other")

# Vertebrae.
refused("no faces", orthonav.VertebraModel, np.zeros((0, 3)), np.zeros((0, 3), int))
refused("triangles: holds float64", orthonav.VertebraModel, level.vertices, level.triangles.astype(float))
refused("triangles: holds -1", orthonav.VertebraModel, level.vertices, level.triangles.astype(int) - 1)
refused("names vertex 8561", orthonav.VertebraModel, level.vertices[:-1], level.triangles)
refused("edge", orthonav.VertebraModel, level.vertices, level.triangles[1:])
refused("mm", orthonav.VertebraModel, 1e3 * level.vertices, level.triangles)
refused("vertices: holds nan", orthonav.VertebraModel, changed(level.vertices, np.nan, 0, 0), level.triangles)
refused("L9", orthonav.phantom, ["L9"])
refused("nowhere", orthonav.load_case, "/nowhere")
refused("nowhere", orthonav.load_mesh, "/nowhere.stl")
refused("metres_per_unit", orthonav.load_mesh, "/nowhere.stl", float("nan"))
refused("nowhere", orthonav.load_tools, "/nowhere.json")
refused("nowhere", orthonav.Recording, "/nowhere")

# Screws and tools.
refused("side", orthonav.Screw, "up", screw.entry, screw.target)
refused("mm", orthonav.Screw, "left", screw.entry, screw.entry)
refused("radius", orthonav.Screw, "left", screw.entry, screw.target, 0.5)
refused("radius_m", orthonav.Screw, "left", screw.entry, screw.target, float("nan"))
refused("tip", orthonav.Tool, "far", "pointer", 3, 0.04, [0, 5, 0])
refused("role", orthonav.Tool, "odd", "hammer", 3, 0.04, [0, -0.1, 0])
refused("axis", orthonav.Tool, "odd", "guide", 3, 0.04, [0, -0.1, 0], [0, 0, 0])
refused("family", orthonav.Tool, "odd", "guide", 3, 0.04, [0, -0.1, 0], family="tag0h0")

# Cameras and pairs. A pair that is refused leaves the tracker as it was.
refused("px", orthonav.Camera.from_brown_conrady, 0, 48, 45.0, 45.0, 32.0, 24.0)
refused("finite", orthonav.Camera.from_brown_conrady, 64, 48, float("nan"), 45.0, 32.0, 24.0)
refused("unit_plane: has shape", orthonav.Camera.from_lookup, np.zeros((48, 64)))
refused("pixel", orthonav.Camera.from_lookup, np.full((48, 64, 2), np.nan))
refused("right_from_rig", orthonav.Rig, camera, camera, np.eye(4), 2 * np.eye(4))
refused("right_from_rig", orthonav.Rig, camera, camera, np.eye(4), np.diag([1, 1, -1, 1]))
refused("last row", orthonav.Rig, camera, camera, np.eye(4), np.ones((4, 4)))
refused("right_from_rig: has shape", orthonav.Rig, camera, camera, np.eye(4), np.eye(3))
refused("best", orthonav.Tracker, rig, [guide], "other")
refused("tools", orthonav.Tracker, rig, [guide, guide])
tracker = orthonav.Tracker(rig, [guide])


def track(left=grey, right=grey, time_s=1.0, world_from_rig=np.eye(4)):
    return tracker.track(left, right, time_s, world_from_rig)


refused("left: holds float64", track, left=grey.astype(float))
refused("left: holds uint16", track, left=grey.astype(np.uint16))
refused("right: has shape", track, right=np.zeros((48, 64, 3), np.uint8))
refused("32x24", track, right=np.zeros((24, 32), np.uint8))
refused("0x0", track, left=np.zeros((0, 0), np.uint8))
refused("time_s", track, time_s=float("nan"))
refused("time_s", track, time_s=1e300)
refused("world_from_rig", track, world_from_rig=np.zeros((4, 4)))
refused("millimetres", track, world_from_rig=changed(np.eye(4), 1e200, 0, 3))
refused("world_from_rig: shifts by 707.107 m, limit 100 m", track,
        world_from_rig=changed(changed(np.eye(4), 500, 0, 3), -500, 2, 3))
refused("right_from_rig: shifts by 98 m, limit 10 m", orthonav.Rig, camera, camera, np.eye(4),
        changed(np.eye(4), -98, 0, 3))
refused("world_from_rig: has shape", track, world_from_rig=np.eye(4).ravel())
refused("world_from_rig: holds nan", track, world_from_rig=changed(np.eye(4), np.nan, 0, 0))
refused("world_from_rig", track, world_from_rig=np.diag([1, 1, -1, 1]))
assert track()[0].status == "lost" and track(time_s=2.0)[0].world_from_marker is None
refused("2", track, time_s=2.0)
assert track(time_s=3.0, world_from_rig=None)[0].status == "lost"
# Far from where the headset's map began, in metres; columns first in memory, as MATLAB has them.
far = np.asfortranarray(changed(changed(np.eye(4), 60, 0, 3), -70, 2, 3))
assert track(time_s=3.5, world_from_rig=far)[0].status == "lost"
# Rows that are not beside each other in memory.
assert len(track(time_s=4.0, left=np.zeros((96, 128), np.uint8)[::2, ::2])) == 1


# Guidance rests on what is registered and measured, and on nothing else.
def told(screw=screw, registration=np.eye(4), pose=np.eye(4)):
    return orthonav.guide(model, screw, registration, guide, pose)


assert told().clearance_m is None
elsewhere = orthonav.Screw("left", screw.entry + [0, 0, 0.5], screw.target + [0, 0, 0.5], 0.003)
refused("entry lies", told, screw=elsewhere)
refused("entry lies", orthonav.register, model, points, [elsewhere])
flat = np.column_stack([points[:, :2], np.zeros(len(points))])
refused("registration", told, registration=register(flat))
refused("registration: has shape", told, registration=np.eye(3))
refused("registration", told, registration=object())
refused("registration", told, registration=None)
refused("pose: holds nan", told, pose=np.full((4, 4), np.nan))
# In millimetres: beyond what a map spans, or, near its origin, beyond any reach of the screw.
refused("pose: shifts by 500 m", told, pose=changed(np.eye(4), 500, 0, 3))
refused("registration: shifts by 500 m", told, registration=changed(np.eye(4), 500, 0, 3))
refused("are pose and registration in metres?", told, pose=changed(np.eye(4), 80, 0, 3))
refused("are pose and registration in metres?", told, registration=changed(np.eye(4), 80, 0, 3))
refused("mm", register, 1e3 * points)
assert told(registration=far, pose=far).depth_m is not None
refused("not measured", told, pose=track(time_s=5.0)[0])

# Scenes.
assert not orthonav.render_text(scene % "")[..., :3].any()
refused("scene", orthonav.render_text, "")
refused("format", orthonav.render_text, "{}")
refused("holograms[0]", orthonav.render_text, scene % '{"type": "ghost"}')
refused("width_px", orthonav.render_text, (scene % "").replace("32", "1e9"))
refused("nowhere", orthonav.render_file, "/nowhere.json")
refused("no such", orthonav.render_text, scene % "", device="no such card")
refused("nowhere", orthonav.render_text, scene % '{"type": "vertebra", "mesh": "nowhere.stl"}')



# Python can make an object that it never initializes. It is refused wherever it goes, of every class.
def never_initialized(call, *arguments):
    try:
        call(*arguments)
    except TypeError as error:
        assert "initialized" in str(error) or "__init__" in str(error), error
        return
    raise AssertionError(f"{call}{arguments} took an object that was never initialized")


class Forgetful(orthonav.Tracker):
    def __init__(self):
        pass


never_initialized(Forgetful)
never_initialized(orthonav.Tracker.track, Forgetful.__new__(Forgetful), grey, grey, 6.0, np.eye(4))
blank = {name: kind.__new__(kind) for name, kind in vars(orthonav).items()
         if isinstance(kind, type) and kind is not orthonav.Error}
assert len(blank) == 13, sorted(blank)
for name, thing in blank.items():
    for member, value in vars(type(thing)).items():
        if isinstance(value, property):
            never_initialized(getattr, thing, member)
never_initialized(blank["Tracker"].track, grey, grey, 6.0, np.eye(4))
never_initialized(next, blank["Recording"])
never_initialized(orthonav.Rig, blank["Camera"], camera, np.eye(4), np.eye(4))
never_initialized(orthonav.Tracker, blank["Rig"], [guide])
never_initialized(orthonav.Tracker, rig, [guide, blank["Tool"]])
never_initialized(orthonav.register, blank["VertebraModel"], points)
never_initialized(orthonav.register, model, points, [blank["Screw"]])
never_initialized(orthonav.guide, model, blank["Screw"], np.eye(4), guide, np.eye(4))
never_initialized(orthonav.guide, model, screw, blank["Registration"], guide, np.eye(4))
never_initialized(orthonav.guide, model, screw, np.eye(4), guide, blank["TrackedTool"])
# One whose initialization failed is none either; a subclass that does it right is as good as its base.
failed = orthonav.Tracker.__new__(orthonav.Tracker)
refused("tools", failed.__init__, rig, [guide, guide])
never_initialized(failed.track, grey, grey, 1.0, np.eye(4))


class Mine(orthonav.Tracker):
    def __init__(self):
        super().__init__(rig, [guide])


assert Mine().track(grey, grey, 1.0, np.eye(4))[0].status == "lost"

# Another kind of argument altogether is Python's own TypeError, as everywhere.
try:
    orthonav.register("model", points)
except TypeError:
    print("every refusal named what was wrong")
