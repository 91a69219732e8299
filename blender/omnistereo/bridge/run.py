# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""What `blender --background --python` runs: run.py -- SCENE FOLDER ... exports (export.py), run.py -- render ...
renders (cycles.py)."""
import os
import sys
import traceback

OURS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, OURS)
# Blender compiles its exporter each time, which takes a tenth of a conversion: ods names a folder of the user for that.
sys.pycache_prefix = os.environ.get("ODS_PYCACHE")
sys.dont_write_bytecode = sys.pycache_prefix is None

from bridge import cycles, export  # noqa: E402
from bridge.report import say  # noqa: E402

code = 4
arguments = sys.argv[sys.argv.index("--") + 1 :]
try:
    code = cycles.main(arguments[1:]) if arguments[0] == "render" else export.main(arguments)
except BaseException as error:  # Blender would continue with an empty window
    traceback.print_exc()
    say("error", f"our script failed: {type(error).__name__}: {error}")
sys.stderr.flush()
os._exit(code)
