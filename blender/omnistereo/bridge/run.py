# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What `blender --background --python` runs: run.py -- SCENE FOLDER [--bake N] [--scene NAME]."""
import os
import sys
import traceback

OURS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, OURS)
# Blender compiles its exporter anew each time, in a tenth of what a conversion takes.
sys.pycache_prefix = os.path.join(OURS, "compiled")
sys.dont_write_bytecode = False

from bridge.export import main  # noqa: E402
from bridge.report import say  # noqa: E402

code = 4
try:
    code = main(sys.argv[sys.argv.index("--") + 1 :])
except BaseException as error:  # Blender would go on with an empty window
    traceback.print_exc()
    say("error", f"the exporter failed: {type(error).__name__}: {error}")
sys.stderr.flush()
os._exit(code)
