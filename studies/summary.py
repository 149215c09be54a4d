# SPDX-License-Identifier: MIT OR Apache-2.0
"""The end of a run: summary.json for programs, a short table for people."""

from files import write_summary  # noqa: F401


def print_table(rows):
    """rows: (label, text) pairs, lined up."""
    width = max(len(label) for label, _ in rows)
    print()
    for label, text in rows:
        print(f"  {label:<{width}}  {text}")
    print(flush=True)
