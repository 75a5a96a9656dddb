"""What a shoot does, in words, from what was measured of it."""

BEHAVIOURS = {  # marker, colour
    "laid: rights itself": ("o", "#2c7d4f"),
    "laid: rights itself, overshoots by more than 1°": ("^", "#8bc34a"),
    "laid: leaves its plane and finds no rest": ("P", "#7a5195"),
    "upright: small disturbances die out": ("D", "#f2c14e"),
    "upright: swings grow": ("s", "#e07b39"),
    "upright: bends over without swinging": ("X", "#8c2d19"),
}


def at_rest(laid):
    """Whether a shoot laid on its side came to rest. Under the law of actual curvature growth stops only in the plane in
    which it was laid, and under the others none rested outside: what does not move there is a step that undoes itself.
    """
    return laid["rests"] and laid["aside"] < 0.01


def upright_stands(point):
    return point["disturbed"].get("rate", point["disturbed"]["late_rate"]) < 0.0


def behaviour(law, point):
    """Of the first two laws when laid on the side, because small disturbances of an upright shoot die out under both; of
    the third when upright, because laid on the side it winds up."""
    upright, laid = point["disturbed"], point["laid"]
    if law == "relaxation":
        if laid["rests"]:
            raise ValueError("a shoot under relaxation alone came to rest")
        if upright_stands(point):
            return "upright: small disturbances die out"
        swings = upright["frequency"] > 0.1 * upright["rate"]
        return "upright: swings grow" if swings else "upright: bends over without swinging"
    if not upright_stands(point):
        raise ValueError(f"an upright shoot is unstable under the {law} law")
    if not at_rest(laid):
        return "laid: leaves its plane and finds no rest"
    return "laid: rights itself" + (", overshoots by more than 1°" if laid["overshoot"] > 1.0 else "")


def select(results, kind, law=None):
    """Results of a kind with their arguments, law first."""
    chosen = [(r["arguments"], r) for name, r in results.items() if name.startswith(f"{kind}_")]
    return [(arguments, r) for arguments, r in chosen if law in (None, arguments[0])]
