"""What Supple will do with a mesh, as `supple inspect --json` says it."""

import json
import os
import re
import tempfile

import numpy as np

from . import cage, character, command

# By the name of the mesh's object.
reports = {}


class Finding:
    """A line of the panel. `faces`: the mesh's, which the panel can select."""

    def __init__(self, text, faces=(), icon="DOT"):
        self.text = text
        self.faces = [int(f) for f in faces]
        self.icon = icon


class Report:
    def __init__(self, scheme, reason, findings):
        self.scheme = scheme
        self.reason = reason
        self.findings = findings


def blender_faces(mesh):
    """Supple's numbers of faces -> the mesh's: the exporter writes a primitive per material."""
    return np.argsort(cage.column(mesh.polygons, "material_index", 1, np.int32), kind="stable")


def _faces_named(text):
    """The numbers behind "face 12" and "faces 1, 2, 3"."""
    found = []
    for numbers in re.findall(r"\bfaces? (\d+(?:, \d+)*(?: and \d+)?)", text):
        found.extend(int(n) for n in re.findall(r"\d+", numbers))
    return found


def _patches(verdict):
    return ", ".join("%d %s" % (count, name) for name, count in verdict["patches"].items())


def _scheme_findings(name, verdict, numbers):
    if not verdict["accepted"]:
        faces = verdict.get("faces") or _faces_named(verdict["reason"])
        return [Finding("%s: refused: %s" % (name, verdict["reason"]), numbers[faces], "ERROR")]
    found = [Finding("%s: %s" % (name, _patches(verdict)), icon="CHECKMARK")]
    for note in verdict["notes"]:
        found.append(Finding("%s: %s" % (name, note), numbers[_faces_named(note)], "INFO"))
    folds = verdict.get("folds")
    if folds:
        found.append(Finding("%s: %d faces fold over themselves" % (name, folds["faces"]), numbers[folds["all"]], "ERROR"))
    return found


def _modifier_findings(blender_object):
    """Where Blender does what no runtime can: it deforms the subdivided mesh."""
    kinds = [m.type for m in blender_object.modifiers if m.show_viewport]
    if "SUBSURF" in kinds and "ARMATURE" in kinds[kinds.index("SUBSURF"):]:
        return [Finding("Armature stands behind Subdivision: Supple deforms the cage and then makes the surface",
                        icon="ERROR")]
    return []


def make(blender_object, text):
    """`text`: what supple inspect --json printed of the object's file."""
    seen = json.loads(text)
    numbers = blender_faces(blender_object.data)
    known = len(numbers)

    class Numbers:
        """Repairs may number faces beyond the mesh's own."""

        def __getitem__(self, faces):
            return [numbers[f] for f in faces if f < known]

    part = seen["parts"][0]
    findings = _modifier_findings(blender_object)
    for warning in seen["warnings"]:
        findings.append(Finding(warning, Numbers()[_faces_named(warning)], "ERROR"))
    for name in [part["scheme"]] + [n for n in seen["schemes"] if n != part["scheme"]]:
        findings.extend(_scheme_findings(name, seen["schemes"][name], Numbers()))
    return Report(part["scheme"], part["schemeReason"], findings)


def _clip_text(clip):
    """A line such as: walk: 2.20 s; foot.L stands 0.00 to 0.43; packed 7.2:1 within 9.9e-05 of the extent."""
    text = "%s: %.2f s" % (clip["name"], clip["duration"])
    standing = {}
    for contact in clip["contacts"]:
        begin, end = max(contact["begin"], 0.0), min(contact["end"], clip["duration"])
        if begin < end:
            standing.setdefault(contact["joint"], []).append("%.2f to %.2f" % (begin, end))
    for joint, times in sorted(standing.items()):
        text += "; %s stands %s" % (joint, ", ".join(times))
    if "packed" in clip:
        text += "; packed %.1f:1 within %.2g of the extent" % (clip["packed"]["ratio"], clip["packed"]["error"])
    return text


def clips(context, blender_object, folder):
    """What games do with the clips of its armature: when feet stand, and how small they are once they are cooked."""
    path = os.path.join(folder, "clips.glb")
    character.write(context, [blender_object], path, clips=True)
    text, _ = command.run(["inspect", "--json", "--clip-error", "1e-4", path])
    return [Finding(_clip_text(clip), icon="ACTION") for clip in json.loads(text)["clips"]]


def refused(reason):
    """The file as a whole was refused."""
    return Report("none", "refused", [Finding(line, icon="ERROR") for line in str(reason).splitlines()])


def inspect(context, blender_object):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cage.glb")
        character.write(context, [blender_object], path)
        try:
            text, _ = command.run(["inspect", "--json", path])
        except command.CommandError as reason:
            if "cage.glb" not in str(reason):
                raise
            report = refused(reason)
        else:
            report = make(blender_object, text)
            if character.has_clips(blender_object):
                report.findings += clips(context, blender_object, folder)
    reports[blender_object.name] = report
    return report
