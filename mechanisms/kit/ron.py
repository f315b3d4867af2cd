"""Contact models as text (docs/model_format.md), on one line, as the plugin's key `text1` requires."""


def elastic(stiffness, damping, friction=0.0, friction_damping=None):
    """A surface of N/m and N·s/m, with bristle friction unless that is zero."""
    return f"(stiffness: {stiffness!r}, normal: Linear(damping: {damping!r}){_friction(friction, friction_damping)})"


def rigid(friction=0.0):
    """A rigid surface, with the stiffness of the pair's other surface."""
    return f"(stiffness: inf{_friction(friction)})"


def _friction(friction, damping=None):
    if not friction:
        return ""
    more = "" if damping is None else f", damping: {damping!r}"
    return f", friction: Bristle(mu: {friction!r}{more})"


def vector(values):
    return "(" + ", ".join(repr(float(value)) for value in values) + ")"


def primitive(kind, name, **fields):
    """Vectors, numbers, a bare word (a str), and sequences of vectors: two in `ends`, any number in `vertices`."""
    text = ", ".join(f"{key}: {_list(key, value) or _field(value)}" for key, value in fields.items())
    return f'{kind}(name: "{name}", {text})'


def _list(key, value):
    """Text of a list field."""
    if key == "vertices":
        return "[" + ", ".join(map(vector, value)) + "]"
    if key == "faces":
        return "[" + ", ".join(str(list(face)) for face in value) + "]"
    return ""


def _field(value):
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return repr(float(value))
    if isinstance(value[0], (int, float)):
        return vector(value)
    return "(" + ", ".join(map(vector, value)) + ")"


def model(name, surface, primitives=(), groups=()):
    """A model with one surface for all. `groups`: (name, primitives) of movable groups below the root."""
    inside = "" if groups else f", primitives: [{', '.join(primitives)}]"
    if groups:
        made = ", ".join(f'(name: "{n}", movable: true, primitives: [{", ".join(p)}])' for n, p in groups)
        inside = f", groups: [{made}]"
    root = f'(name: "{name}", surface: "steel"{inside})'
    return f'(format: "pong-model", version: 1, name: "{name}", surfaces: {{ "steel": {surface} }}, root: {root})'
