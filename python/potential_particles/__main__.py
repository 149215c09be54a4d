# SPDX-License-Identifier: MIT OR Apache-2.0
"""python -m potential_particles demo [FILE]: two particles and their contact, as numbers and as a picture."""
import argparse
import sys

from .demo import demo


def main():
    parser = argparse.ArgumentParser(prog="python -m potential_particles",
                                     description="Contact detection between potential particles.")
    commands = parser.add_subparsers(dest="command", required=True)
    drawn = commands.add_parser("demo", help="draw two particles and their contact")
    drawn.add_argument("file", nargs="?", default="contact.png", help="a picture (default: contact.png)")
    return demo(parser.parse_args().file)


sys.exit(main())
