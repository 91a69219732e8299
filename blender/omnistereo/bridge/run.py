# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What `blender --background --python` runs: run.py -- SCENE FOLDER [--bake N] [--scene NAME]."""
import os
import sys
import traceback

OURS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, OURS)
# Blender compiles its exporter each time, which takes a tenth of a conversion: ods names a folder of the user for that.
sys.pycache_prefix = os.environ.get("ODS_PYCACHE")
sys.dont_write_bytecode = sys.pycache_prefix is None

from bridge.export import main  # noqa: E402
from bridge.report import say  # noqa: E402

code = 4
try:
    code = main(sys.argv[sys.argv.index("--") + 1 :])
except BaseException as error:  # Blender would continue with an empty window
    traceback.print_exc()
    say("error", f"the exporter failed: {type(error).__name__}: {error}")
sys.stderr.flush()
os._exit(code)
