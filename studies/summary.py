# SPDX-License-Identifier: MIT OR Apache-2.0
"""The end of a run: summary.json for programs, a short table for people."""

import json


def write_summary(path, summary):
    """Writes a dictionary of plain values as JSON; what is not a number becomes null."""
    path.write_text(json.dumps(_plain(summary), indent=2) + "\n")


def print_table(rows):
    """rows: (label, text) pairs, lined up."""
    width = max(len(label) for label, _ in rows)
    print()
    for label, text in rows:
        print(f"  {label:<{width}}  {text}")
    print(flush=True)


def _plain(value):
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return None
    return value
