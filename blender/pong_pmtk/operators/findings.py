# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that check a model, go to a finding, and repair it."""

import json

import bpy

from ..core.finding import FIXES
from ..scene import fixes, session
from ..scene.instances import SEPARATOR, unique_names
from ..store import elements
from ..store.references import current_root, select_only
from ..store.state import keep_findings, state


def culprit(context, name):
    """The object of a finding; for an instance, the object that shows it."""
    named = {key: obj for obj, key in unique_names(context.scene.objects).items()}
    while name:
        obj = named.get(name)
        if obj is not None:
            return obj
        name = name.rpartition(SEPARATOR)[0]
    return None


class PONG_OT_check(bpy.types.Operator):
    """List what is wrong with the current model; nothing is changed"""

    bl_idname = "pong.check"
    bl_label = "Check"
    bl_options = {"REGISTER"}

    def execute(self, context):
        root = current_root(context)
        result = session.check(context, root.name if root else "")
        keep_findings(context, result.findings, result.name, session.touches(result))
        self.report({"WARNING" if result.model is None else "INFO"}, result.summary())
        return {"FINISHED"}


class OnFinding:
    """Operators on one finding of the list."""

    index: bpy.props.IntProperty(name="Finding", default=-1, description="-1: the active one")

    @classmethod
    def poll(cls, context):
        if not len(state(context).findings):
            cls.poll_message_set("There are no findings: run the check")
            return False
        return True

    def finding(self, context):
        found = state(context)
        index = found.active_finding if self.index < 0 else self.index
        return found.findings[min(index, len(found.findings) - 1)]


class PONG_OT_finding_select(OnFinding, bpy.types.Operator):
    """Select the object the finding is about, and its elements in Edit Mode"""

    bl_idname = "pong.finding_select"
    bl_label = "Go to Finding"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def description(cls, context, properties):
        found = state(context).findings
        if not 0 <= properties.index < len(found):
            return "Select the object the finding is about, and its elements in Edit Mode"
        finding = found[properties.index]
        return f"{finding.path or 'The scene'}: {finding.cause}; {finding.cure}. Click to select the object"

    def execute(self, context):
        finding = self.finding(context)
        obj = culprit(context, finding.object)
        if obj is None:
            self.report({"WARNING"}, f"{finding.path or 'The scene'}: there is no object to select")
            return {"CANCELLED"}
        chosen = json.loads(finding.elements) if finding.elements else {}
        if context.mode != "OBJECT" and not (obj.mode == "EDIT" and chosen):
            bpy.ops.object.mode_set(mode="OBJECT")
        if context.mode == "OBJECT":
            select_only(context, [obj], obj)
        if chosen and obj.type == "MESH" and obj.name == finding.object:
            self._elements(context, obj, chosen)
        return {"FINISHED"}

    def _elements(self, context, obj, chosen):
        if obj.mode != "EDIT":
            bpy.ops.object.mode_set(mode="EDIT")
        context.tool_settings.mesh_select_mode = ("vertices" in chosen, "edges" in chosen, "faces" in chosen)
        elements.select(obj.data, chosen)


class PONG_OT_finding_fix(OnFinding, bpy.types.Operator):
    """Make the repair that the finding offers, and check again"""

    bl_idname = "pong.finding_fix"
    bl_label = "Fix"
    bl_options = {"REGISTER", "UNDO"}

    fix: bpy.props.StringProperty(name="Repair", description="Empty: that of the finding")

    @classmethod
    def description(cls, context, properties):
        offered = properties.fix
        found = state(context).findings
        if not offered and 0 <= properties.index < len(found):
            offered = found[properties.index].fix
        return (FIXES.get(offered) or "make the repair that the finding offers").capitalize()

    def execute(self, context):
        finding = self.finding(context)
        name, obj = self.fix or finding.fix, culprit(context, finding.object)
        if name not in fixes.REPAIRS or obj is None:
            self.report({"ERROR"}, f"{finding.path}: there is no repair for this; {finding.cure}")
            return {"CANCELLED"}
        try:
            fixes.run(context, name, obj)
        except (fixes.FixFault, ValueError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        again = _check_again(context)
        self.report({"INFO"}, f"{obj.name}: {FIXES.get(name, name)}. {again.summary()}")
        return {"FINISHED"}


class PONG_OT_findings_fix(OnFinding, bpy.types.Operator):
    """Make the repairs of all findings, or of all of one kind, and check again"""

    bl_idname = "pong.findings_fix"
    bl_label = "Fix All"
    bl_options = {"REGISTER", "UNDO"}

    rule: bpy.props.StringProperty(name="Rule", description="Only findings of this rule. Empty: all that offer a repair")

    @classmethod
    def description(cls, _context, properties):
        which = f"every finding [{properties.rule}]" if properties.rule else "every finding that offers one"
        return f"Make the repair of {which}, and check again"

    def execute(self, context):
        made, refused, tried = 0, [], set()
        while (finding := self._next(context, tried)) is not None:
            name, obj = finding.fix, culprit(context, finding.object)
            tried.add((finding.object, finding.path, finding.rule))
            try:
                fixes.run(context, name, obj)
                made += 1
            except (fixes.FixFault, ValueError) as error:
                refused.append(str(error))
                continue
            # One repair may fix, move or rename the objects of other findings.
            _check_again(context)
        if not made and not refused:
            self.report({"ERROR"}, "There is nothing to repair here: no such finding offers a repair")
            return {"CANCELLED"}
        told = f"{made} repair{'s' * (made != 1)} made"
        for reason in refused:
            self.report({"WARNING"}, f"Not repaired: {reason}")
        self.report({"INFO"}, f"{told}. {summary(context)}")
        return {"FINISHED"}

    def _next(self, context, tried):
        for finding in state(context).findings:
            wanted = finding.fix in fixes.REPAIRS and self.rule in ("", finding.rule)
            is_new = (finding.object, finding.path, finding.rule) not in tried
            if wanted and is_new and culprit(context, finding.object) is not None:
                return finding
        return None


def _check_again(context):
    context.view_layer.update()
    again = session.check(context, state(context).checked)
    keep_findings(context, again.findings, again.name, session.touches(again))
    return again


def summary(context):
    """Summary of the remaining findings."""
    left = state(context).findings
    return f"{len(left)} finding{'s' * (len(left) != 1)} left" if len(left) else "Nothing is left to find fault with"


class PONG_OT_fix(bpy.types.Operator):
    """Make a repair on the selected objects"""

    bl_idname = "pong.fix"
    bl_label = "Repair Selected"
    bl_options = {"REGISTER", "UNDO"}

    fix: bpy.props.EnumProperty(name="Repair", items=[
        (name, name.replace("-", " ").title(), FIXES.get(name, "")) for name in sorted(fixes.REPAIRS)])

    @classmethod
    def poll(cls, context):
        if context.view_layer.objects.active is None:
            cls.poll_message_set("Select an object")
            return False
        return True

    def execute(self, context):
        chosen = [obj for obj in context.view_layer.objects if obj.select_get()]
        for obj in chosen or [context.view_layer.objects.active]:
            try:
                fixes.run(context, self.fix, obj)
            except (fixes.FixFault, ValueError) as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        return {"FINISHED"}


class PONG_OT_findings_copy(bpy.types.Operator):
    """Copy the list of findings to the clipboard"""

    bl_idname = "pong.findings_copy"
    bl_label = "Copy Findings"

    def execute(self, context):
        lines = [
            f"{item.path or 'scene'}: {item.severity} [{item.rule}] {item.cause}; {item.cure}"
            for item in state(context).findings
        ]
        context.window_manager.clipboard = "\n".join(lines)
        return {"FINISHED"}


CLASSES = (PONG_OT_check, PONG_OT_finding_select, PONG_OT_finding_fix, PONG_OT_findings_fix, PONG_OT_fix, PONG_OT_findings_copy)
