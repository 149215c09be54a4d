# SPDX-License-Identifier: MIT OR Apache-2.0
"""Values that the user may set in the environment; a bad one ends the script with one sentence."""

import os
import pathlib


def whole_number(name, default, least, meaning):
    """The environment variable `name` as a whole number of at least `least`."""
    text = os.environ.get(name, "").strip()
    if not text:
        return default
    try:
        value = int(text.replace("_", "").replace(",", ""))
    except ValueError:
        value = None
    if value is None or value < least:
        raise SystemExit(
            f"{name}={text} is no {meaning}: give a whole number of at least {least}, "
            f"or leave {name} out for {default}."
        )
    return value


def choice(name, default, choices, meaning):
    """The environment variable `name`, which must be one of `choices`."""
    text = os.environ.get(name, "").strip()
    if not text:
        return default
    if text not in choices:
        raise SystemExit(
            f"{name}={text} is no {meaning}: give one of {', '.join(choices)}, "
            f"or leave {name} out for {default}."
        )
    return text


def folder(name, default):
    """The environment variable `name` as a folder to write to."""
    return pathlib.Path(os.environ.get(name, "").strip() or default)
