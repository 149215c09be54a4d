# SPDX-License-Identifier: MIT OR Apache-2.0
"""The guide as a site: scripts/yade.sh -j1 docs/build.py FOLDER. Sphinx runs within YADE, since it describes its
classes; each warning is an error.
"""
import os
import sys

import potential_particles  # noqa: F401 (so that the classes are there)
from sphinx.cmd.build import build_main

source, site = os.path.dirname(os.path.abspath(sys.argv[0])), sys.argv[-1]
# Each page anew: what the sources of the plugin say is no file that Sphinx watches.
sys.exit(
    build_main(["-E", "-W", "--keep-going", "-q", "-b", "html", "-d",
                os.path.join(site, ".doctrees"), source, site]))
